// A synthetic shadow map, and points to look up in it. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_SHADOW_MAP_TEST_H
#define REFLET_TESTS_SHADOW_MAP_TEST_H

#include "base/shared.h"
#include "effects/shadow/shadow.h"

SHARED_BEGIN

struct ShadowScene {
    ShadowMapParams map;
    mat4 shadowToWorld;
    vec4 receiver;      // plane: dot(receiver, (p, 1)) = 0
    vec4 occluder;      // plane; all zeros: none
    vec4 occluderEdge;  // the occluder is there where dot(occluderEdge, (p, 1)) < 0
    float bias;         // in texels, or
    uint constant;      // 1: in metres, and the bias of constantBiasVisibility
    uint resolution;
    uint packedNormal;  // 1: the normal comes through a G-buffer
};

struct ShadowCase {
    vec3 point;
    vec3 normal;
};

SHARED_END

#endif
