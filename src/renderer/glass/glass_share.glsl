// What a transmissive surface lets through of light that passes it straight.
#ifndef REFLET_GLASS_SHARE_GLSL
#define REFLET_GLASS_SHARE_GLSL

#include "renderer/material.h"
#include "shaders/ggx.glsl"
#include "shaders/luminance.glsl"

// At normal incidence. transmission: with the texture. color: linear base colour.
vec3 glassShare(MaterialParams m, float transmission, vec3 color) {
    vec3 f0 = min(m.f0, vec3(25.0)) * (m.f90 * dielectricF0);
    float reflected = min(max(f0.r, max(f0.g, f0.b)), 1.0);
    return transmission * (1.0 - m.metallic) * (1.0 - reflected) * clamp(color, 0.0, 1.0);
}

#endif
