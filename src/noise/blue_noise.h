// Blue noise in space and time: a mask that tiles the screen, with a slice for each frame in turn. In a slice, values
// near one another differ; at a pixel, values of successive slices do. Shared by C++ and GLSL. (Wolfe et al.,
// Spatiotemporal Blue Noise Masks, EGSR 2022)
#ifndef REFLET_NOISE_BLUE_NOISE_H
#define REFLET_NOISE_BLUE_NOISE_H

#include "base/shared.h"

SHARED_BEGIN

const uint blueNoiseSide = 64;  // pixels
const uint blueNoiseSlices = 32;

SHARED_END

#ifdef __cplusplus

#include <span>

namespace reflet {

/// side · side · slices texels, x fastest, slices last. Low and high 16 bits are two masks that know nothing of one
/// another, as 16-bit fractions of 1; each slice has every one of 4096 values once. Made by make_blue_noise.
std::span<const uint32_t> blueNoise();

}  // namespace reflet
#endif

#endif
