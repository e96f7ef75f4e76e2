// Outputs of projection_test.comp for a world point. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_PROJECTION_TEST_H
#define REFLET_TESTS_PROJECTION_TEST_H

#include "base/shared.h"

SHARED_BEGIN

const vec3 planePoint = vec3(1.0, -2.0, 0.5);
const vec3 planeNormal = vec3(0.6, 0.48, -0.64);

struct ProjectedPoint {
    vec2 uv;
    float depth;
    float distance;  // depthToViewDistance of that depth
    vec3 back;       // uvToWorld of that uv and depth
    vec3 toEye;
    float above;  // by planeOnScreen of the plane above
};

SHARED_END

#endif
