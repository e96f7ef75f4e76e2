// Compares an image with a reference: error metrics and a FLIP map.
#pragma once

#include "base/image_file.h"
#include "compare/octaves.h"

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
    float pixelsPerDegree = 67.0F;                ///< of the eye that FLIP assumes, 1..1000
    std::vector<bool> mask;                       ///< pixels to compare; empty: all
    std::string imageName = "the image";          ///< for messages
    std::string referenceName = "the reference";  ///< for messages
    bool octaves = false;                         ///< whether to fill Difference::octaves
};

struct Difference {
    double relativeMse = 0.0;  ///< mean over pixels and channels of (a - b)² / (b² + floor); b is the reference
    /// 10 log10(peak² / mean of (a - b)²) [dB], infinite for identical images. The peak is 1 for display images, the
    /// largest |b| for linear ones (1 if the reference is all 0).
    double psnr = 0.0;
    double flip = 0.0;       ///< mean FLIP, 0 (identical) to 1
    double mean = 0.0;       ///< mean over pixels and channels of |a - b|
    double bias = 0.0;       ///< mean of a / mean of b - 1: above 0 too bright; 0 if both means are 0
    double max = 0.0;        ///< largest |a - b|
    uint64_t pixels = 0;     ///< number of pixels compared
    OctaveErrors octaves{};  ///< parts of relativeMse; 0 unless CompareOptions::octaves
};

struct Comparison {
    Difference difference;
    FloatImage flip;  ///< "Y": FLIP of every pixel, 0..1, regardless of the mask
};

/// Both images must have the same size and the same number of channels: 1 (grey) or 3. Throws Error for different sizes
/// or channels, for NaN or infinity (naming image, pixel and channel; even in masked pixels, because FLIP filters over
/// neighbours), for a mask of another size or without pixels, and for pixelsPerDegree out of range. For FLIP alone,
/// values below 0 and, in display images, above 1 are clamped. The result does not depend on the number of threads.
Comparison compareImages(const FloatImage& image, const FloatImage& reference, const CompareOptions& options);

/// Throws as compareImages does for the images, so that they can be checked before a mask is made.
void checkComparable(const FloatImage& image, const FloatImage& reference, const CompareOptions& options);

/// Describes a number of Difference, for tables and limits.
struct Metric {
    std::string_view name;  ///< "relative_mse"
    std::string_view unit;  ///< "dB"; empty for most
    std::string_view definition;
    bool largeIsGood;
    double (*value)(const Difference&);
};

/// relative_mse, psnr, flip, mean, bias, max.
std::span<const Metric> metrics();

/// octave_2_4, octave_4_8, ..., octave_64_up: those of Difference::octaves.
std::span<const Metric> octaveMetrics();

}  // namespace reflet
