// Look-ups in a filtered cube map and their results. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_CUBE_MAP_TEST_H
#define REFLET_TESTS_CUBE_MAP_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct CubeLookup {
    vec3 direction;  // unit
    float roughness;
    uint cube;
};

struct CubeLight {
    vec3 sharp;
    vec3 lobe;
    vec3 irradiance;  // over pi
};

SHARED_END

#endif
