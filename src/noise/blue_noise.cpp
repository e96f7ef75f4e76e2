// The masks, as the build made them.
#include "noise/blue_noise.h"

namespace reflet {

namespace {

constexpr uint32_t texels[] = {
#include "blue_noise.inc"
};

}  // namespace

std::span<const uint32_t> blueNoise() {
    static_assert(std::size(texels) == size_t{blueNoiseSide} * blueNoiseSide * blueNoiseSlices);
    return texels;
}

}  // namespace reflet
