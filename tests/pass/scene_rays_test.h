// Rays to trace, and what they hit. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_SCENE_RAYS_TEST_H
#define REFLET_TESTS_SCENE_RAYS_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct TestRay {
    vec3 origin;
    float nearest;
    vec3 direction;
    float farthest;
};

struct TestHit {
    float distance;
    vec2 barycentrics;
    uint instance;
    uint firstIndex;
    uint found;  // by closestHit
    uint any;    // by anyHit
};

SHARED_END

#endif
