// What a transmissive surface lets through of light that passes it straight, where only one number is kept.
#ifndef REFLET_GLASS_SHARE_GLSL
#define REFLET_GLASS_SHARE_GLSL

#include "renderer/material.h"
#include "shaders/ggx.glsl"
#include "shaders/luminance.glsl"

// At normal incidence. transmission: with the texture. color: linear base colour.
float glassShare(MaterialParams m, float transmission, vec3 color) {
    vec3 f0 = min(m.f0, vec3(25.0)) * (m.f90 * dielectricF0);
    float reflected = min(max(f0.r, max(f0.g, f0.b)), 1.0);
    return transmission * (1.0 - m.metallic) * (1.0 - reflected) * luminance(clamp(color, 0.0, 1.0));
}

// Extinction of the volume for light that is white on average [1/m], exact after its thickness.
float glassExtinction(MaterialParams m, float thickness) {
    float path = clamp(thickness, 1e-3, 1e3);
    return m.thickness > 0.0 ? -log(max(luminance(exp(-m.extinction * path)), 1e-6)) / path : 0.0;
}

#endif
