// Computes the metrics and validates their input.
#include "compare/compare.h"

#include "base/color.h"
#include "base/error.h"
#include "base/message.h"
#include "compare/color.h"
#include "compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

constexpr float lowestPixelsPerDegree = 1.0F;
constexpr float highestPixelsPerDegree = 1000.0F;

size_t pixelCount(const FloatImage& image) {
    return size_t{image.width} * image.height;
}

// Reports the first NaN or infinity, and counts the others.
void checkFinite(const FloatImage& image, const std::string& name) {
    const auto isBad = [](float value) { return !std::isfinite(value); };
    const auto found = std::ranges::find_if(image.data, isBad);
    if (found == image.data.end()) {
        return;
    }
    const auto index = static_cast<size_t>(found - image.data.begin());
    const size_t pixel = index / image.channels.size();
    const auto others = std::count_if(found + 1, image.data.end(), isBad);
    fail("{}: {} at pixel ({}, {}), channel {}{}", name, std::isnan(*found) ? "NaN" : "infinity", pixel % image.width,
         pixel / image.width, image.channels[index % image.channels.size()],
         others == 0 ? "" : fmt::format(", and {} more that are NaN or infinity", others));
}

void checkOptions(const FloatImage& image, const CompareOptions& options) {
    if (!(options.pixelsPerDegree >= lowestPixelsPerDegree && options.pixelsPerDegree <= highestPixelsPerDegree)) {
        fail("{} pixels per degree: must be {} to {}", options.pixelsPerDegree, lowestPixelsPerDegree,
             highestPixelsPerDegree);
    }
    if (options.mask.empty()) {
        return;
    }
    if (options.mask.size() != pixelCount(image)) {
        fail("the mask has {} pixels, but the images have {}", options.mask.size(), pixelCount(image));
    }
    if (std::ranges::find(options.mask, true) == options.mask.end()) {
        fail("the mask leaves no pixels to compare");
    }
}

// FLIP's input is linear red, green and blue; grey is replicated to all three.
Planes3 linearPlanes(const FloatImage& image, ImageKind kind) {
    Planes3 planes = makePlanes3(image.width, image.height);
    const size_t channels = image.channels.size();
    for (size_t c = 0; c < planes.size(); ++c) {
        for (size_t i = 0; i < pixelCount(image); ++i) {
            const float value = image.data[i * channels + c % channels];
            planes[c].data[i] = kind == ImageKind::display ? decodeSrgb(value) : value;
        }
    }
    return planes;
}

double floorOf(const FloatImage& reference, ImageKind kind) {
    if (kind == ImageKind::display) {
        return relativeErrorFloor;
    }
    const size_t channels = reference.channels.size();
    std::vector<float> luminances;
    for (size_t i = 0; i < reference.data.size(); i += channels) {
        const float* c = &reference.data[i];
        luminances.push_back(channels == 3 ? luminance({c[0], c[1], c[2]}) : c[0]);
    }
    return relativeErrorFloorFor(std::move(luminances));
}

// Sums in double and in the order of the pixels.
Difference differenceOf(const FloatImage& image, const FloatImage& reference, const Plane& flip,
                        const CompareOptions& options, double floor) {
    Difference d;
    double squares = 0.0;
    double sumA = 0.0;
    double sumB = 0.0;
    double peak = 0.0;
    const size_t channels = image.channels.size();
    for (size_t i = 0; i < pixelCount(image); ++i) {
        if (!options.mask.empty() && !options.mask[i]) {
            continue;
        }
        ++d.pixels;
        d.flip += flip.data[i];
        for (size_t value = i * channels; value < (i + 1) * channels; ++value) {
            const double b = reference.data[value];
            const double error = std::abs(image.data[value] - b);
            squares += error * error;
            d.relativeMse += error * error / (b * b + floor);
            d.mean += error;
            sumA += image.data[value];
            sumB += b;
            d.max = std::max(d.max, error);
            peak = std::max(peak, std::abs(b));
        }
    }
    const double values = static_cast<double>(d.pixels) * static_cast<double>(channels);
    d.flip /= static_cast<double>(d.pixels);
    d.relativeMse /= values;
    d.mean /= values;
    d.bias = sumA == sumB ? 0.0 : sumA / sumB - 1.0;
    if (options.kind == ImageKind::display || peak == 0.0) {
        peak = 1.0;
    }
    d.psnr =
        squares == 0.0 ? std::numeric_limits<double>::infinity() : 10.0 * std::log10(peak * peak * values / squares);
    return d;
}

}  // namespace

void checkComparable(const FloatImage& image, const FloatImage& reference, const CompareOptions& options) {
    if (image.width != reference.width || image.height != reference.height) {
        fail("{} is {}x{}, but {} is {}x{}: only images of the same size can be compared", options.imageName,
             image.width, image.height, options.referenceName, reference.width, reference.height);
    }
    if (image.channels.size() != reference.channels.size()) {
        fail("{} has the channels {}, but {} has {}: only images with the same number of channels can be compared",
             options.imageName, listed(image.channels), options.referenceName, listed(reference.channels));
    }
    if (image.channels.size() != 1 && image.channels.size() != 3) {
        fail("{} has the channels {}: only images with 1 or 3 channels can be compared", options.imageName,
             listed(image.channels));
    }
    if (pixelCount(image) == 0) {
        fail("{} has no pixels", options.imageName);
    }
    for (const FloatImage* each : {&image, &reference}) {
        REFLET_CHECK(each->data.size() == pixelCount(*each) * each->channels.size(), "{}x{}, {} channels, {} values",
                     each->width, each->height, each->channels.size(), each->data.size());
    }
    checkFinite(image, options.imageName);
    checkFinite(reference, options.referenceName);
}

Comparison compareImages(const FloatImage& image, const FloatImage& reference, const CompareOptions& options) {
    checkComparable(image, reference, options);
    checkOptions(image, options);
    const auto flipOf = options.kind == ImageKind::display ? ldrFlip : hdrFlip;
    Plane flip =
        flipOf(linearPlanes(image, options.kind), linearPlanes(reference, options.kind), options.pixelsPerDegree);
    const double floor = floorOf(reference, options.kind);
    Difference difference = differenceOf(image, reference, flip, options, floor);
    if (options.octaves) {
        difference.octaves = errorByOctave(image, reference, options.mask, floor);
    }
    return {difference, {flip.width, flip.height, {"Y"}, std::move(flip.data)}};
}

std::span<const Metric> metrics() {
    static constexpr std::array<Metric, 6> all{{
        {"relative_mse", "",
         "mean over pixels and channels of (a - b)² / (b² + 0.01); of radiance with light tones beyond 1/256 to 32, "
         "that of "
         "both divided by a power of two that makes these about 1",
         false, [](const Difference& d) { return d.relativeMse; }},
        {"psnr", "dB",
         "10 log10(peak² / mean of (a - b)²); the peak is 1 for display images, the largest |b| for linear ones", true,
         [](const Difference& d) { return d.psnr; }},
        {"flip", "",
         "mean over pixels of FLIP (Andersson et al. 2020), 0 (identical) to 1; linear images: HDR-FLIP (2021)", false,
         [](const Difference& d) { return d.flip; }},
        {"mean", "", "mean over pixels and channels of |a - b|", false, [](const Difference& d) { return d.mean; }},
        {"bias", "", "mean of a / mean of b - 1: above 0 too bright, below 0 too dark", false,
         [](const Difference& d) { return d.bias; }},
        {"max", "", "largest |a - b| of any pixel and channel", false, [](const Difference& d) { return d.max; }},
    }};
    return all;
}

std::span<const Metric> octaveMetrics() {
    static constexpr std::array<Metric, octaveCount> all{{
        {"octave_2_4", "", "relative_mse in the octave of wavelengths of 2 to 4 pixels: noise from pixel to pixel",
         false, [](const Difference& d) { return d.octaves[0]; }},
        {"octave_4_8", "", "4 to 8 pixels", false, [](const Difference& d) { return d.octaves[1]; }},
        {"octave_8_16", "", "8 to 16 pixels: mottling, as of denoised noise", false,
         [](const Difference& d) { return d.octaves[2]; }},
        {"octave_16_32", "", "16 to 32 pixels", false, [](const Difference& d) { return d.octaves[3]; }},
        {"octave_32_64", "", "32 to 64 pixels", false, [](const Difference& d) { return d.octaves[4]; }},
        {"octave_64_up", "", "64 pixels and more, with the mean; all octaves sum to relative_mse", false,
         [](const Difference& d) { return d.octaves[5]; }},
    }};
    return all;
}

}  // namespace reflet
