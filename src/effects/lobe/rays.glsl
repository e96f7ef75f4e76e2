// Packing of rays, shared by the generator and all ray sources: slots, lists, results.
#ifndef REFLET_RAYS_GLSL
#define REFLET_RAYS_GLSL

#include "effects/lobe/rays.h"
#include "shaders/half_float.glsl"
#include "shaders/octahedral.glsl"

// 14 bits per coordinate (images of up to 16384 pixels, see maxFrameSize), 4 bits for the layer.
uint packSlot(ivec3 slot) { return uint(slot.x) | (uint(slot.y) << 14u) | (uint(slot.z) << 28u); }
ivec3 unpackSlot(uint bits) { return ivec3(bits & 0x3fffu, (bits >> 14u) & 0x3fffu, bits >> 28u); }

// A ray that still has no complete result.
struct WaitingRay {
    ivec3 slot;   // pixel and layer
    float rest;   // remaining weight, 0..1, in 16 bits
    float clear;  // metres along the ray known to be unoccluded, where the next source may continue; a half float, rounded down
    bool lost;    // there it passed behind a visible surface: whether it hits something is unknown
    vec3 inFront;  // radiance of that surface, if it is known; positive small floats of 6, 6 and 5 bits of mantissa
};

uint packSmallFloats(vec3 v) {
    v = clampToHalf(v);
    uint red = packHalf2x16(vec2(v.r, 0.0)) >> 4u;
    uint green = packHalf2x16(vec2(v.g, 0.0)) >> 4u;
    return red | (green << 11u) | ((packHalf2x16(vec2(v.b, 0.0)) >> 5u) << 22u);
}
vec3 unpackSmallFloats(uint bits) {
    vec2 redGreen = unpackHalf2x16(((bits & 0x7ffu) << 4u) | (((bits >> 11u) & 0x7ffu) << 20u));
    return vec3(redGreen, unpackHalf2x16((bits >> 22u) << 5u).x);
}

RayItem packWaitingRay(WaitingRay ray) {
    uint clear = packHalf2x16(vec2(min(ray.clear * (1.0 - 1.0 / 2048.0), largestHalf), 0.0));
    uint lost = ray.lost ? 0x8000u : 0u;  // in the half's sign bit
    return RayItem(packSlot(ray.slot), uint(ray.rest * 65535.0 + 0.5) | ((clear | lost) << 16u),
                   packSmallFloats(ray.inFront));
}
WaitingRay unpackWaitingRay(RayItem item) {
    return WaitingRay(unpackSlot(item.slot), float(item.restAndClear & 0xffffu) / 65535.0,
                      unpackHalf2x16((item.restAndClear >> 16u) & 0x7fffu).x, (item.restAndClear & 0x80000000u) != 0u,
                      unpackSmallFloats(item.inFront));
}

// Whether the ray is known to hit nothing.
bool isKnownMiss(WaitingRay ray) { return ray.clear > 0.99 * largestHalf; }

struct Ray {
    vec3 direction;  // world space, unit
    float weight;    // of the ray's radiance in the pixel's mean, at least 0
    float trust;     // largest confidence allowed for a screen hit, 0..1, in steps of 1/255
    float spread;    // footprint, in steps of 1/255. 0: a single direction. Specular: a cone, the lobe of this perceptual
                     // roughness. Diffuse, 1: the hemisphere around it
    bool highlighted;  // a highlight stands for the emitters that the ray meets: it leaves their light out
};

uvec2 packRay(Ray ray) {
    uint shares = packUnorm4x8(vec4(ray.trust, ray.spread, 0.0, 0.0));
    uint weight = packHalf2x16(vec2(ray.weight, 0.0)) & 0x7fffu;
    return uvec2(packUnitVector(ray.direction), weight | (ray.highlighted ? 0x8000u : 0u) | (shares << 16u));
}
Ray unpackRay(uvec2 bits) {
    vec2 shares = unpackUnorm4x8(bits.y >> 16u).xy;
    return Ray(unpackUnitVector(bits.x), unpackHalf2x16(bits.y & 0x7fffu).x, shares.x, shares.y, (bits.y & 0x8000u) != 0u);
}

// A source's result for a ray. confidence: the share of the ray's weight that it covers, 0..1.
struct RayAnswer {
    vec3 radiance;
    float confidence;
    float hitDistance;  // metres
};

// Weighted results of a ray so far, as the images `answer` and `source` keep them.
struct AnswerSum {
    vec4 light;   // radiance, hit distance [m]
    vec4 colors;  // of the sources; alpha: confidence
};

// rest: the ray's weight left by the previous sources. Returns the weight left after this one.
float addAnswer(inout AnswerSum sum, RayAnswer a, float rest, vec4 color) {
    float weight = rest * clamp(a.confidence, 0.0, 1.0);
    if (weight > 0.0) {
        sum.light = min(sum.light + weight * vec4(clampToHalf(a.radiance), a.hitDistance), vec4(largestHalf));
        sum.colors += weight * color;
    }
    return rest - weight;
}

// The image `source` (AOV): a colour per source; alpha: confidence, 1 for sources that find the actual hit. Probes and
// the environment are approximations.
const vec4 sourceScreen = vec4(0.2, 0.8, 0.3, 1.0);        // green
const vec4 sourcePlanar = vec4(0.2, 0.8, 0.85, 1.0);       // cyan
const vec4 sourceScene = vec4(0.95, 0.75, 0.2, 1.0);       // yellow
const vec4 sourceProbe = vec4(0.8, 0.3, 0.75, 0.0);        // magenta
const vec4 sourceEnvironment = vec4(0.25, 0.45, 0.9, 0.0);  // blue

// Vulkan's guaranteed minimum of groups per dispatch; with longer lists each thread processes several rays.
const uint maxListGroups = 65535u;
const uint listGroupSize = 64u;

#endif
