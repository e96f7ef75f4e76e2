// What the passes of the denoiser share: how they keep a pixel's surface, and which are alike.
#ifndef REFLET_DENOISE_GLSL
#define REFLET_DENOISE_GLSL

#include "render/denoise/denoise.h"
#include "shaders/directional_light.glsl"
#include "shaders/half_float.glsl"
#include "shaders/luminance.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/shadow_kernel.glsl"

// At most this perceptual roughness, reflections have no noise worth cleaning, and edges that blur would spoil.
const float smoothRoughness = 0.1;

// A pixel's surface as the denoiser keeps it.
struct KeptSurface {
    float depth;  // reversed; 0: there is none, or none with this lobe
    vec3 normal;  // shading, world space, within 0.04 degrees
    float roughness;
};

uvec2 packSurface(KeptSurface s) {
    uvec2 n = uvec2(octahedralEncode(s.normal) * 2047.5 + 2048.0);
    uint roughness = uint(clamp(s.roughness, 0.0, 1.0) * 255.0 + 0.5);
    return uvec2(floatBitsToUint(s.depth), min(n.x, 4095u) | (min(n.y, 4095u) << 12u) | (roughness << 24u));
}

KeptSurface unpackSurface(uvec2 bits) {
    vec2 n = (vec2(bits.y & 4095u, (bits.y >> 12u) & 4095u) - 2047.5) / 2047.5;
    return KeptSurface(uintBitsToFloat(bits.x), octahedralDecode(n), float(bits.y >> 24u) / 255.0);
}

// How far another surface's light may be taken for this one's, 0..1, by normals and roughness.
float surfaceSimilarity(KeptSurface a, KeptSurface b, uint lobe) {
    float facing = max(dot(a.normal, b.normal), 0.0);
    float f4 = facing * facing * facing * facing;
    if (lobe == 0u) {
        return f4 * f4;
    }
    float rough = clamp(1.0 - 8.0 * abs(a.roughness - b.roughness), 0.0, 1.0);
    float f16 = f4 * f4 * f4 * f4;
    return f16 * f16 * rough;
}

// The same for diffuse light that is turned to the surface's own normal (directional_light.glsl).
float normalSimilarity(KeptSurface a, KeptSurface b) {
    float facing = max(dot(a.normal, b.normal), 0.0);
    return facing * facing;
}

#endif
