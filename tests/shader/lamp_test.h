// A lamp and a point in its light. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_LAMP_TEST_H
#define REFLET_TESTS_LAMP_TEST_H

#include "base/shared.h"
#include "effects/lamps.h"

SHARED_BEGIN

struct LampCase {
    LampParams lamp;
    vec3 point;
};

struct LampLight {
    vec3 irradiance;
    vec3 toLamp;
};

SHARED_END

#endif
