// An undecimated pyramid ("à trous": Holschneider, Kronland-Martinet, Morlet, Tchamitchian, 1989). Each level filters
// the one before with the same kernel, its taps twice as far apart. Mean squares of successive levels are subtracted
// instead of filtering by band, so that the octaves sum to the total whatever the filter is. No difference is negative,
// because the filter amplifies no frequency, at borders either: images are mirrored there, which makes cosines the
// filter's eigenfunctions.
#include "compare/octaves.h"

#include "base/exposure.h"
#include "compare/filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace reflet {

namespace {

// One side of a symmetric kernel: the weight of the pixel itself, then those of both neighbours at each distance.
using HalfKernel = std::vector<float>;

// The maximally flat low-pass filter (Herrmann: On the Approximation Problem in Nonrecursive Digital Filter Design,
// 1971) with the frequency response P(X <= flatness), X binomial with 13 trials of probability y = sin²(ω / 2):
// monotone from 1 to 0, and 0.7095 for a wavelength of 4 pixels, where it passes half of the power (0.503).
HalfKernel lowPass() {
    constexpr size_t trials = 13;
    constexpr size_t flatness = 7;
    constexpr size_t center = trials;
    using Taps = std::array<double, 2 * trials + 1>;
    const auto times = [](const Taps& taps, double side, double middle) {
        Taps product{};
        for (size_t i = 0; i < taps.size(); ++i) {
            product[i] =
                middle * taps[i] + side * ((i > 0 ? taps[i - 1] : 0.0) + (i + 1 < taps.size() ? taps[i + 1] : 0.0));
        }
        return product;
    };
    Taps sum{};
    double choices = 1.0;  // of k in `trials`
    for (size_t k = 0; k <= flatness; ++k) {
        Taps term{};
        term[center] = choices;
        for (size_t i = 0; i < trials; ++i) {
            term = i < k ? times(term, -0.25, 0.5) : times(term, 0.25, 0.5);  // y, and 1 - y = cos²(ω / 2)
        }
        std::ranges::transform(sum, term, sum.begin(), std::plus());
        choices *= static_cast<double>(trials - k) / static_cast<double>(k + 1);
    }
    return {sum.begin() + center, sum.end()};
}

// The index in 0..size-1 of a pixel beyond the borders: … 1 0 | 0 1 … size-1 | size-1 …
uint32_t mirrored(int64_t index, uint32_t size) {
    const int64_t period = 2 * int64_t{size};
    const int64_t inside = (index % period + period) % period;
    return static_cast<uint32_t>(inside < size ? inside : period - 1 - inside);
}

void addPair(std::span<float> target, float weight, const float* a, const float* b) {
    for (size_t x = 0; x < target.size(); ++x) {
        target[x] += weight * (a[x] + b[x]);
    }
}

void setScaled(std::span<float> target, float weight, const float* source) {
    for (size_t x = 0; x < target.size(); ++x) {
        target[x] = weight * source[x];
    }
}

void smoothRows(const Plane& in, const HalfKernel& kernel, size_t spacing, Plane& out) {
    const size_t radius = spacing * (kernel.size() - 1);
    forEachRow(in.height, [&](uint32_t y) {
        std::vector<float> padded(in.width + 2 * radius);
        for (size_t i = 0; i < padded.size(); ++i) {
            padded[i] = in.row(y)[mirrored(static_cast<int64_t>(i) - static_cast<int64_t>(radius), in.width)];
        }
        const std::span<float> target(out.row(y), in.width);
        const float* at = padded.data() + radius;
        setScaled(target, kernel[0], at);
        for (size_t i = 1; i < kernel.size(); ++i) {
            addPair(target, kernel[i], at - i * spacing, at + i * spacing);
        }
    });
}

void smoothColumns(const Plane& in, const HalfKernel& kernel, size_t spacing, Plane& out) {
    forEachRow(in.height, [&](uint32_t y) {
        const std::span<float> target(out.row(y), in.width);
        setScaled(target, kernel[0], in.row(y));
        for (size_t i = 1; i < kernel.size(); ++i) {
            const auto distance = static_cast<int64_t>(i * spacing);
            addPair(target, kernel[i], in.row(mirrored(y - distance, in.height)),
                    in.row(mirrored(y + distance, in.height)));
        }
    });
}

double sumOfSquares(const Plane& plane) {
    return std::transform_reduce(plane.data.begin(), plane.data.end(), 0.0, std::plus(),
                                 [](float value) { return double(value) * value; });
}

// The relative error of one channel, in the order of the pixels.
std::vector<double> relativeError(const FloatImage& image, const FloatImage& reference, const std::vector<bool>& mask,
                                  size_t channel, double floor) {
    const size_t channels = image.channels.size();
    std::vector<double> error(image.data.size() / channels);
    for (size_t i = 0; i < error.size(); ++i) {
        if (mask.empty() || mask[i]) {
            const double b = reference.data[i * channels + channel];
            error[i] = (image.data[i * channels + channel] - b) / std::sqrt(b * b + floor);
        }
    }
    return error;
}

// Sums of squares. Without the mean, which is all in the last octave, so that its rounding errors reach no other one.
OctaveErrors sumsByOctave(const std::vector<double>& error, uint32_t width, uint32_t height, const HalfKernel& kernel) {
    OctaveErrors sums{};
    const auto count = static_cast<double>(error.size());
    const double mean = std::accumulate(error.begin(), error.end(), 0.0) / count;
    double largest = 0.0;
    for (const double value : error) {
        largest = std::max(largest, std::abs(value - mean));
    }
    sums.back() = mean * mean * count;
    if (largest == 0.0) {
        return sums;
    }
    Plane level(width, height);
    Plane rows(width, height);
    // Scaled to at most 1: relative errors of dark pixels exceed the range of float.
    std::ranges::transform(error, level.data.begin(),
                           [&](double value) { return static_cast<float>((value - mean) / largest); });
    double rest = sumOfSquares(level);
    for (size_t octave = 0; octave + 1 < octaveCount; ++octave) {
        const size_t spacing = size_t{1} << octave;
        smoothRows(level, kernel, spacing, rows);
        smoothColumns(rows, kernel, spacing, level);
        const double lower = std::min(sumOfSquares(level), rest);  // rounding alone can make it larger
        sums[octave] = (rest - lower) * largest * largest;
        rest = lower;
    }
    sums.back() += rest * largest * largest;
    return sums;
}

}  // namespace

double relativeErrorFloorFor(std::vector<float> luminances) {
    constexpr double lightShare = 0.9;
    if (luminances.empty()) {
        return relativeErrorFloor;
    }
    const auto light = luminances.begin() + static_cast<std::ptrdiff_t>(lightShare * double(luminances.size() - 1));
    std::ranges::nth_element(luminances, light);
    const double unit = 1.0 / preExposureFor(*light);
    return relativeErrorFloor * unit * unit;
}

OctaveErrors errorByOctave(const FloatImage& image, const FloatImage& reference, const std::vector<bool>& mask,
                           double floor) {
    static const HalfKernel kernel = lowPass();
    const size_t channels = image.channels.size();
    const size_t pixels = image.data.size() / channels;
    const auto compared = mask.empty() ? static_cast<double>(pixels) : double(std::ranges::count(mask, true));
    OctaveErrors errors{};
    for (size_t channel = 0; channel < channels; ++channel) {
        const OctaveErrors sums =
            sumsByOctave(relativeError(image, reference, mask, channel, floor), image.width, image.height, kernel);
        for (size_t i = 0; i < octaveCount; ++i) {
            errors[i] += sums[i] / (compared * static_cast<double>(channels));
        }
    }
    return errors;
}

}  // namespace reflet
