// Owen-scrambled Sobol pairs.
#include "reference/sampler.h"

#include "base/sobol.h"

namespace reflet {

namespace {

float toUnit(uint32_t x) {
    return static_cast<float>(x >> 8U) * 0x1p-24F;
}

}  // namespace

vec2 PixelSampler::pair(uint32_t pair) const {
    const uint32_t seed = mixBits(stream_ + pair * 0x9e3779b9U);
    // Shuffles the index to decorrelate pairs, by a nested permutation that keeps every power-of-two set stratified.
    const uint32_t reversed = owenScrambled(reverseBits(sample_), seed);
    const uint32_t index = reverseBits(reversed);
    // The first dimension is the bit-reversed index, so that scrambling works on the index itself.
    const uint32_t x = reverseBits(owenScrambled(index, mixBits(seed + 1)));
    const uint32_t y = reverseBits(owenScrambled(reverseBits(sobolSecond(reversed)), mixBits(seed + 2)));
    return {toUnit(x), toUnit(y)};
}

}  // namespace reflet
