// Points of the unit square for the rays of a pixel: a low-discrepancy sequence for the pixel, shifted (Cranley and
// Patterson 1976) by a mask of blue noise, so that what error is left differs between neighbours and between frames.
// (Georgiev and Fajardo, Blue-noise Dithered Sampling, SIGGRAPH talks 2016; masks: see noise/blue_noise.h)
// The includer defines, before it includes this: uint loadBlueNoise(uint texel).
#ifndef REFLET_BLUE_NOISE_GLSL
#define REFLET_BLUE_NOISE_GLSL

#include "noise/blue_noise.h"
#include "shaders/noise.glsl"

// Point `index` of Sobol's first two dimensions, as 32-bit fractions of 1. Of any 2^k points that start at a multiple of
// 2^k, each box of area 2^-k with sides of powers of two has one. (Sobol 1967)
uvec2 sobolPoint(uint index) {
    // The second dimension's generator matrix is Pascal's triangle modulo 2, a Kronecker power of ((1, 1), (0, 1)): a
    // step for each factor.
    uint first = bitfieldReverse(index);
    uint second = first;
    second ^= (second & 0x0000ffffu) << 16u;
    second ^= (second & 0x00ff00ffu) << 8u;
    second ^= (second & 0x0f0f0f0fu) << 4u;
    second ^= (second & 0x33333333u) << 2u;
    second ^= (second & 0x55555555u) << 1u;
    return uvec2(first, second);
}

// Where in the masks a pixel looks. Streams (lobes, seeds) are moved against one another.
uint blueNoiseTexel(uvec2 pixel, uint stream, uint frame) {
    uint move = hashPcg(stream);
    uvec2 at = (pixel + uvec2(move, move >> 8u)) % blueNoiseSide;
    uint slice = (frame + (move >> 16u)) % blueNoiseSlices;
    return (slice * blueNoiseSide + at.y) * blueNoiseSide + at.x;
}

// For ray `number` of the pixel's `count`. A frame takes the mask's next slice; once all have been used, the rays take
// the sequence's next points, so that more frames always bring something new.
vec2 blueNoisePoint(uvec2 pixel, uint stream, uint frame, uint number, uint count) {
    uint mask = loadBlueNoise(blueNoiseTexel(pixel, stream, frame));
    uvec2 point = sobolPoint(frame / blueNoiseSlices * count + number);
    point += uvec2(mask << 16u, mask & 0xffff0000u);  // modulo 1
    return vec2(hashToUnit(point.x), hashToUnit(point.y));
}

#endif
