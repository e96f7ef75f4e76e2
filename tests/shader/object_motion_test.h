// An object in front of a mirror, input of object_motion_test.comp. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_OBJECT_MOTION_TEST_H
#define REFLET_TESTS_OBJECT_MOTION_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct MirroredThing {
    vec3 thing;   // world space
    vec2 uv;      // where it is seen
    vec3 motion;  // of the G-buffer there
    vec3 mirror;  // where its image is seen
};

struct ObjectMotion {
    vec3 displacement;
    vec2 ofImage;
};

SHARED_END

#endif
