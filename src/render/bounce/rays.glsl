// Rays as the generator and the sources share them: slots, lists, answers.
#ifndef REFLET_RAYS_GLSL
#define REFLET_RAYS_GLSL

#include "render/bounce/rays.h"
#include "shaders/half_float.glsl"
#include "shaders/octahedral.glsl"

// The largest image that Vulkan devices of the floor have is 16384: 14 bits a coordinate, 4 bits for the layer.
uint packSlot(ivec3 slot) { return uint(slot.x) | (uint(slot.y) << 14u) | (uint(slot.z) << 28u); }
ivec3 unpackSlot(uint bits) { return ivec3(bits & 0x3fffu, (bits >> 14u) & 0x3fffu, bits >> 28u); }

// A ray that waits for an answer.
struct WaitingRay {
    ivec3 slot;   // pixel and layer
    float rest;   // how much of its weight is left, 0..1; kept in 16 bits
    float clear;  // metres along it up to which it has met nothing, and from where the next source may go on; a half
                  // float, rounded down
    bool lost;    // there it went behind something that the screen shows, and nobody knows what it meets
};

RayItem packWaitingRay(WaitingRay ray) {
    uint clear = packHalf2x16(vec2(min(ray.clear * (1.0 - 1.0 / 2048.0), largestHalf), 0.0));
    uint lost = ray.lost ? 0x8000u : 0u;  // where the sign would be
    return RayItem(packSlot(ray.slot), uint(ray.rest * 65535.0 + 0.5) | ((clear | lost) << 16u));
}
WaitingRay unpackWaitingRay(RayItem item) {
    return WaitingRay(unpackSlot(item.slot), float(item.restAndClear & 0xffffu) / 65535.0,
                      unpackHalf2x16((item.restAndClear >> 16u) & 0x7fffu).x, (item.restAndClear & 0x80000000u) != 0u);
}

// Known to meet nothing at all.
bool isKnownMiss(WaitingRay ray) { return ray.clear > 0.99 * largestHalf; }

struct Ray {
    vec3 direction;  // world space, unit
    float weight;    // of its radiance in the pixel's mean
    float trust;     // how far the screen may answer it, 0..1, in steps of 1/255
    float spread;    // what it stands for, in steps of 1/255. 0: its direction alone. Specular: all of the lobe of this
                     // perceptual roughness around it. Diffuse, 1: the hemisphere around it
};

uvec2 packRay(Ray ray) {
    uint shares = packUnorm4x8(vec4(ray.trust, ray.spread, 0.0, 0.0));
    return uvec2(packUnitVector(ray.direction), (packHalf2x16(vec2(ray.weight, 0.0)) & 0xffffu) | (shares << 16u));
}
Ray unpackRay(uvec2 bits) {
    vec2 shares = unpackUnorm4x8(bits.y >> 16u).xy;
    return Ray(unpackUnitVector(bits.x), unpackHalf2x16(bits.y).x, shares.x, shares.y);
}

// What a source says of a ray. confidence: the share of the ray's weight that it answers, 0..1.
struct RayAnswer {
    vec3 radiance;
    float confidence;
    float hitDistance;  // metres
};

// The image `source`: a colour for each, and in alpha whether it knows what the ray met (the confidence). Probes and the
// environment only stand in.
const vec4 sourceScreen = vec4(0.2, 0.8, 0.3, 1.0);        // green
const vec4 sourcePlanar = vec4(0.2, 0.8, 0.85, 1.0);       // cyan
const vec4 sourceScene = vec4(0.95, 0.75, 0.2, 1.0);       // yellow
const vec4 sourceProbe = vec4(0.8, 0.3, 0.75, 0.0);        // magenta
const vec4 sourceEnvironment = vec4(0.25, 0.45, 0.9, 0.0); // blue

// Vulkan promises this many groups; threads of a list take several rays where there are more.
const uint maxListGroups = 65535u;
const uint listGroupSize = 64u;

#endif
