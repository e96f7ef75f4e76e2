// Sample points of the unit square for the rays of a pixel: a low-discrepancy sequence, shifted per pixel by a
// blue-noise mask and per frame by another sequence (Cranley-Patterson rotation), so that the remaining error differs
// between neighbours and between frames. (Georgiev and Fajardo, Blue-noise Dithered Sampling, SIGGRAPH talks 2016; masks: see noise/blue_noise.h)
// The includer defines, before it includes this: uint loadBlueNoise(uint texel).
#ifndef REFLET_BLUE_NOISE_GLSL
#define REFLET_BLUE_NOISE_GLSL

#include "noise/blue_noise.h"
#include "shaders/noise.glsl"

// Point `index` of the first two Sobol dimensions, as 32-bit fractions of 1. Among any 2^k points that start at a
// multiple of 2^k, each box of area 2^-k whose sides are powers of two holds exactly one. (Sobol 1967)
uvec2 sobolPoint(uint index) {
    // The generator matrix of the second dimension is Pascal's triangle modulo 2, a Kronecker power of ((1, 1), (0,
    // 1)): one step per factor.
    uint first = bitfieldReverse(index);
    uint second = first;
    second ^= (second & 0x0000ffffu) << 16u;
    second ^= (second & 0x00ff00ffu) << 8u;
    second ^= (second & 0x0f0f0f0fu) << 4u;
    second ^= (second & 0x33333333u) << 2u;
    second ^= (second & 0x55555555u) << 1u;
    return uvec2(first, second);
}

// Index of a pixel's mask texel. Streams (lobes, seeds) are offset against one another.
uint blueNoiseTexel(uvec2 pixel, uint stream) {
    uint move = hashPcg(stream);
    uvec2 at = (pixel + uvec2(move, move >> 8u)) % blueNoiseSide;
    return at.y * blueNoiseSide + at.x;
}

// A pixel's shift in a frame, as 32-bit fractions of 1: its mask, and a Kronecker sequence over frames that never
// repeats. The points of any run of frames are evenly spread in each pixel, so that means over frames converge faster
// than those of random numbers, and those of one frame in each neighbourhood. The steps are of the best among some
// thousand pairs, by the discrepancy (L2) of 8 to 48 points: of all frames, of every second and fourth, of those in
// which a pixel of four traces (pixelRays), and together with the subpixel jitter (jitter.cpp): at most 0.6 of that of
// random points. (L. Kuipers and H. Niederreiter, Uniform Distribution of Sequences, 1974)
uvec2 blueNoiseShift(uvec2 pixel, uint stream, uint frame) {
    uint mask = loadBlueNoise(blueNoiseTexel(pixel, stream));
    return uvec2(mask << 16u, mask & 0xffff0000u) + frame * uvec2(0x349f3d4bu, 0xafae35b9u);
}

// Shifts one of a sequence's first `count` points by `shift`, modulo 1. With 2^k points, a shift over the whole square
// would map the set almost onto itself for 2^k values of the shift, and the blue-noise property would be lost. So the
// square is cut into 2^k boxes with one point each, and points are shifted within their boxes. `scramble` (its highest
// and lowest 16 bits) permutes the boxes; if `count` is no power of two, that alone spreads each ray evenly.
uvec2 shiftPoint(uvec2 point, uvec2 shift, uint scramble, uint count) {
    uint k = uint(findMSB(count));
    uvec2 cuts = uvec2(k / 2u, k - k / 2u);
    uvec2 inside = uvec2(0xffffffffu) >> cuts;
    uvec2 box = (point ^ uvec2(scramble, scramble << 16u)) & ~inside;
    return box | ((point + (shift >> cuts)) & inside);
}

// Sample point of ray `number` of `count` (1 to 2^16).
vec2 blueNoisePoint(uvec2 pixel, uint stream, uint frame, uint number, uint count) {
    uvec2 point = shiftPoint(sobolPoint(number), blueNoiseShift(pixel, stream, frame), hashPixel(pixel, stream, frame),
                             count);
    return vec2(hashToUnit(point.x), hashToUnit(point.y));
}

#endif
