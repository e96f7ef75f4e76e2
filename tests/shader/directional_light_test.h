// Inputs and outputs of directional_light_test.comp. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_DIRECTIONAL_LIGHT_TEST_H
#define REFLET_TESTS_DIRECTIONAL_LIGHT_TEST_H

#include "base/shared.h"

SHARED_BEGIN

// Radiance 1 comes from all directions within a cone.
struct LitSurface {
    vec3 normal;        // unit: of the surface whose rays are drawn
    vec3 turnedTo;      // unit
    vec3 middle;        // of the cone, unit
    float leastCosine;  // to its middle
};

struct TurnedLight {
    float mean;    // over the rays: what the surface gets, over pi
    float factor;  // of turning it
};

SHARED_END

#endif
