// The random numbers of one sample of one pixel: Sobol's first two dimensions, Owen-scrambled anew for every pair that
// a path asks for. (Burley, Practical Hash-based Owen Scrambling, JCGT 2020)
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet {

/// A permutation of all 32-bit numbers without visible order. (Wellons' lowbias32)
inline uint32_t mixBits(uint32_t x) {
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    x ^= x >> 16U;
    return x;
}

class PixelSampler {
public:
    PixelSampler(uint32_t pixel, uint32_t seed, uint32_t sample)
        : stream_(mixBits(pixel ^ mixBits(seed ^ 0x9e3779b9U))), sample_(sample) {}

    /// Two numbers in [0, 1). Over the samples of a pixel, each `pair` is a low-discrepancy set of its own; the sets
    /// are independent of one another.
    [[nodiscard]] vec2 pair(uint32_t pair) const;

private:
    uint32_t stream_;
    uint32_t sample_;
};

}  // namespace reflet
