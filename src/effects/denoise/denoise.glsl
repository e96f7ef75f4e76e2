// Shared by the denoiser's passes: packed surfaces and their similarity.
#ifndef REFLET_DENOISE_GLSL
#define REFLET_DENOISE_GLSL

#include "effects/denoise/denoise.h"
#include "effects/lobe/answer_environment.h"
#include "shaders/directional_light.glsl"
#include "shaders/half_float.glsl"
#include "shaders/luminance.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/shadow_kernel.glsl"

// Up to this perceptual roughness, reflections have little noise and sharp edges that a blur would destroy.
const float smoothRoughness = 0.1;

// How near the surroundings are that diffuse light comes from: 1 / distance in pixels, 0: the environment. Its mean gives the
// harmonic mean of the rays' distances, which bounds how fast irradiance changes along a surface (Ward, Rubinstein and Clear, A
// Ray Tracing Solution for Diffuse Interreflection, SIGGRAPH 1988). What is nearer than a few pixels is bumps and crevices of
// the surface itself: a few such rays must not end the blur.
float nearnessOf(float hitDistance, float pixelWidth) {
    const float leastPixels = 8.0;
    return hitDistance < environmentDistance ? pixelWidth / max(hitDistance, leastPixels * pixelWidth) : 0.0;
}

// A pixel's surface in the denoiser's history.
struct KeptSurface {
    float depth;  // reversed; 0: no surface with this lobe
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

// Edge-stopping weight by normals and roughness, 0..1. sharpness: how fast that of reflections falls with 1 - cosine, beyond what
// it falls for all of them.
float surfaceSimilarity(KeptSurface a, KeptSurface b, uint lobe, float sharpness) {
    float facing = max(dot(a.normal, b.normal), 0.0);
    if (lobe == 0u) {
        float f4 = facing * facing * facing * facing;
        return f4 * f4;
    }
    float rough = clamp(1.0 - 8.0 * abs(a.roughness - b.roughness), 0.0, 1.0);
    return exp(-(32.0 + sharpness) * max(1.0 - facing, 0.0)) * rough;
}

// The same for diffuse light that is adapted to each surface's normal (directional_light.glsl).
float normalSimilarity(KeptSurface a, KeptSurface b) {
    float facing = max(dot(a.normal, b.normal), 0.0);
    return facing * facing;
}

#endif
