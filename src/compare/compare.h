// How far a picture is from the truth: numbers, and a map of where.
#pragma once

#include "base/image_file.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

enum class ImageKind : uint8_t {
    linear,   ///< radiance, 0 and up: FLIP is HDR-FLIP
    display,  ///< sRGB-encoded, 0..1: FLIP is LDR-FLIP
};

struct CompareOptions {
    ImageKind kind = ImageKind::linear;
    float pixelsPerDegree = 67.0F;            ///< of the eye that FLIP assumes, 1..1000
    std::vector<bool> mask;                   ///< per pixel, what counts; empty: everything
    std::string pictureName = "the image";    ///< for messages
    std::string truthName = "the reference";  ///< for messages
};

struct Difference {
    double relativeMse = 0.0;  ///< mean over pixels and channels of (a - b)² / (b² + 0.01), b being the truth
    /// 10 log10(peak² / mean of (a - b)²) [dB], infinite for equal pictures. The peak is 1 for display pictures, the
    /// largest |b| for linear ones (1 where the truth is all 0).
    double psnr = 0.0;
    double flip = 0.0;    ///< mean FLIP, 0 equal to 1
    double mean = 0.0;    ///< mean over pixels and channels of |a - b|
    double bias = 0.0;    ///< mean of a over mean of b, minus 1: above 0 there is too much light; 0 where both are 0
    double max = 0.0;     ///< largest |a - b|
    uint64_t pixels = 0;  ///< that counted
};

struct Comparison {
    Difference difference;
    FloatImage flip;  ///< "Y": FLIP of every pixel, 0..1; not masked
};

/// Both of the same size and with the same number of channels (1 or 3; one is grey). Throws Error for different sizes
/// or channels, for NaN or infinity (naming picture, pixel and channel; the mask does not hide them, because FLIP looks
/// around each pixel), where the mask has another size or leaves nothing, and for pixelsPerDegree out of range. What
/// FLIP cannot see, values below 0 and, in display pictures, above 1, counts as the limit for FLIP alone. The result
/// does not depend on the number of threads.
Comparison compareImages(const FloatImage& picture, const FloatImage& truth, const CompareOptions& options);

/// Throws as compareImages does for the pictures themselves: to say what is wrong with them before a mask is made.
void checkComparable(const FloatImage& picture, const FloatImage& truth, const CompareOptions& options);

/// One of the numbers of Difference, for tables and limits.
struct Metric {
    std::string_view name;  ///< "relative_mse"
    std::string_view unit;  ///< "dB"; empty for most
    std::string_view definition;
    bool largeIsGood;
    double (*value)(const Difference&);
};

/// relative_mse, psnr, flip, mean, bias, max.
std::span<const Metric> metrics();

}  // namespace reflet
