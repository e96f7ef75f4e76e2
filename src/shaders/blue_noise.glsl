// Points of the unit square for the rays of a pixel: a low-discrepancy sequence, shifted in each pixel by a mask of blue
// noise, so that what error is left differs between neighbours and between frames.
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

// Shifts a point of a sequence's first `count` by `shift`, modulo 1. With 2^k points a shift over the whole square would
// bring back much the same set 2^k times, and whatever is blue in the shift would be lost: the square is cut into 2^k
// boxes, which have a point each, and points are shifted within theirs. Which box is whose, `scramble` says (highest and
// lowest 16 bits); where `count` is no power of two, each ray is spread evenly only by that.
uvec2 shiftPoint(uvec2 point, uvec2 shift, uint scramble, uint count) {
    uint k = uint(findMSB(count));
    uvec2 cuts = uvec2(k / 2u, k - k / 2u);
    uvec2 inside = uvec2(0xffffffffu) >> cuts;
    uvec2 box = (point ^ uvec2(scramble, scramble << 16u)) & ~inside;
    return box | ((point + (shift >> cuts)) & inside);
}

// For ray `number` of the pixel's `count` (1 to 2^16). A frame takes the mask's next slice; once all have been used, the
// rays take the sequence's next points, so that more frames always bring something new. stride: of these points; `count`,
// or where that changes from frame to frame a power of two that it never exceeds.
vec2 blueNoisePoint(uvec2 pixel, uint stream, uint frame, uint number, uint count, uint stride) {
    uint mask = loadBlueNoise(blueNoiseTexel(pixel, stream, frame));
    uvec2 point = shiftPoint(sobolPoint(frame / blueNoiseSlices * stride + number),
                             uvec2(mask << 16u, mask & 0xffff0000u), hashPixel(pixel, stream, frame), count);
    return vec2(hashToUnit(point.x), hashToUnit(point.y));
}
vec2 blueNoisePoint(uvec2 pixel, uint stream, uint frame, uint number, uint count) {
    return blueNoisePoint(pixel, stream, frame, number, count, count);
}

#endif
