// Cases of ggx_*_test.comp. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_GGX_TEST_H
#define REFLET_TESTS_GGX_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct GgxMaterial {
    vec3 baseColor;
    float metallic;
    float roughness;
    uint lambert;
};

struct GgxCase {
    GgxMaterial material;
    vec3 v;  // around the normal +Z, unit
    vec3 l;
};

struct GgxResult {
    vec3 reflected;  // brdfTimesCosine
    vec3 diffuse;    // of the surface
    vec3 specular;
    vec3 singleScattering;  // reflected specular light over the compensation and nl: the plain BRDF
    vec2 table;
};

// A part of the integral of brdfTimesCosine over the hemisphere: directions of one angle from the normal.
struct GgxRing {
    GgxMaterial material;
    float nv;
    uint ring;
    uint rings;
    uint around;        // directions in half a turn: the other half mirrors it
    uint byHalfVector;  // 1: of half vectors, spread like the GGX distribution
};

SHARED_END

#endif
