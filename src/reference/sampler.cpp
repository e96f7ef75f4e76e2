// Owen-scrambled Sobol pairs.
#include "reference/sampler.h"

namespace reflet {

namespace {

uint32_t reverseBits(uint32_t x) {
    x = (x << 16U) | (x >> 16U);
    x = ((x & 0x00ff00ffU) << 8U) | ((x & 0xff00ff00U) >> 8U);
    x = ((x & 0x0f0f0f0fU) << 4U) | ((x & 0xf0f0f0f0U) >> 4U);
    x = ((x & 0x33333333U) << 2U) | ((x & 0xccccccccU) >> 2U);
    return ((x & 0x55555555U) << 1U) | ((x & 0xaaaaaaaaU) >> 1U);
}

// A hash in which each bit depends only on lower bits; on reversed bits it is an Owen scrambling.
// (Laine and Karras, Stratified Sampling for Stochastic Transparency, EGSR 2011; constants: Vegdahl 2021)
uint32_t scrambleUpwards(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return x;
}

// Sobol's second dimension: its generator matrix is Pascal's triangle modulo 2, the fifth Kronecker power of
// ((1, 1), (0, 1)), so that five steps multiply by it. Input and output have reversed bits.
uint32_t pascal(uint32_t x) {
    x ^= (x & 0x0000ffffU) << 16U;
    x ^= (x & 0x00ff00ffU) << 8U;
    x ^= (x & 0x0f0f0f0fU) << 4U;
    x ^= (x & 0x33333333U) << 2U;
    x ^= (x & 0x55555555U) << 1U;
    return x;
}

float toUnit(uint32_t x) {
    return static_cast<float>(x >> 8U) * 0x1p-24F;
}

}  // namespace

vec2 PixelSampler::pair(uint32_t pair) const {
    const uint32_t seed = mixBits(stream_ + pair * 0x9e3779b9U);
    // Shuffles the index to decorrelate pairs, by a nested permutation that keeps every power-of-two set stratified.
    const uint32_t reversed = scrambleUpwards(reverseBits(sample_), seed);
    const uint32_t index = reverseBits(reversed);
    // The first dimension is the bit-reversed index, so that scrambling works on the index itself.
    const uint32_t x = reverseBits(scrambleUpwards(index, mixBits(seed + 1)));
    const uint32_t y = reverseBits(scrambleUpwards(reverseBits(pascal(reversed)), mixBits(seed + 2)));
    return {toUnit(x), toUnit(y)};
}

}  // namespace reflet
