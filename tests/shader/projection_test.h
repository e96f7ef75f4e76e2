// What projection_test.comp says of a world point. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_PROJECTION_TEST_H
#define REFLET_TESTS_PROJECTION_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct ProjectedPoint {
    vec2 uv;
    float depth;
    float distance;  // depthToViewDistance of that depth
    vec3 back;       // uvToWorld of that uv and depth
    vec3 toEye;
};

SHARED_END

#endif
