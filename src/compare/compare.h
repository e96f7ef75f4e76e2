// How far a picture is from the truth: numbers, and a map of where.
#pragma once

#include "base/image_file.h"

#include <cstdint>
#include <vector>

namespace reflet {

enum class ImageKind : uint8_t {
    linear,   ///< radiance, 0 and up: FLIP is HDR-FLIP
    display,  ///< sRGB-encoded, 0..1: FLIP is LDR-FLIP
};

struct CompareOptions {
    ImageKind kind = ImageKind::linear;
    float pixelsPerDegree = 67.0F;  ///< of the eye that FLIP assumes
    std::vector<bool> mask;         ///< per pixel, what counts; empty: everything
};

struct Difference {
    double relativeMse = 0.0;  ///< mean over pixels and channels of (a - b)² / (b² + 0.01), b being the truth
    double psnr = 0.0;         ///< 10 log10(peak² / mean of (a - b)²) [dB], infinite for equal pictures
    double flip = 0.0;         ///< mean FLIP, 0 equal to 1
    double mean = 0.0;         ///< mean over pixels and channels of |a - b|
    double max = 0.0;          ///< largest |a - b|
    uint64_t pixels = 0;       ///< that counted
};

struct Comparison {
    Difference difference;
    FloatImage flip;  ///< "Y": FLIP of every pixel, 0..1; not masked
};

/// Both of the same size and with the same number of channels (1 or 3). Throws Error for different sizes, for NaN or
/// infinity (naming picture, pixel and channel), and where the mask leaves nothing.
Comparison compareImages(const FloatImage& picture, const FloatImage& truth, const CompareOptions& options);

}  // namespace reflet
