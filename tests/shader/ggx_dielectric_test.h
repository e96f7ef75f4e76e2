// Cases of ggx_dielectric_test.comp. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_GGX_DIELECTRIC_TEST_H
#define REFLET_TESTS_GGX_DIELECTRIC_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct DielectricCase {
    vec3 baseColor;
    float metallic;
    vec4 dielectric;  // F0, F90
    float roughness;
    float nv;
};

struct DielectricResult {
    vec3 diffuse;  // of the surface
    vec3 specular;
    vec3 energy;  // integral of brdfTimesCosine
    vec3 f0;
    float f90;
};

SHARED_END

#endif
