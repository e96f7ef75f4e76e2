// Random numbers for a sample of a pixel: the first two Sobol dimensions with an independent Owen scrambling for every
// pair that a path requests (padding). (Burley, Practical Hash-based Owen Scrambling, JCGT 2020)
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet {

/// A bijective 32-bit integer hash. (Wellons' lowbias32)
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

    /// Two numbers in [0, 1). Over the samples of a pixel each `pair` is a low-discrepancy set, independent of the
    /// others.
    [[nodiscard]] vec2 pair(uint32_t pair) const;

    /// Random bits, independent for each index and sample; never 0.
    [[nodiscard]] uint32_t bits(uint32_t index) const {
        return mixBits(stream_ ^ mixBits(sample_ ^ mixBits(index ^ 0x68bc21ebU))) | 1U;
    }

private:
    uint32_t stream_;
    uint32_t sample_;
};

}  // namespace reflet
