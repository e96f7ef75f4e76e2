// Per-pixel noise for the samples of shadow filters.
// The includer defines, before it includes this: uint loadBlueNoise(uint texel).
#ifndef REFLET_SHADOW_NOISE_GLSL
#define REFLET_SHADOW_NOISE_GLSL

#include "effects/shadow/shadow.h"
#include "shaders/blue_noise.glsl"

// Two numbers for the filter and two for the blocker search. stream: an even number, one for each light.
vec4 shadowNoise(ivec2 pixel, ViewParams view, bool rings, uint stream) {
    uvec2 at = uvec2(pixel);
    if (rings) {
        uint h = hashPixel(at, view.seed + stream, view.frame);
        return vec4(hashToUnit2(h), hashToUnit2(hashPcg(h)));
    }
    uvec2 ofFilter = blueNoiseShift(at, stream + view.seed, view.frame);
    uvec2 ofSearch = blueNoiseShift(at, stream + 1u + view.seed, view.frame);
    return vec4(ofFilter >> 8u, ofSearch >> 8u) / 16777216.0;
}

#endif
