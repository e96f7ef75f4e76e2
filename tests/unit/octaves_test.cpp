// The split of the relative MSE by octave: patterns of one wavelength, white noise, a constant, sums and borders.
#include "compare/octaves.h"

#include "base/math.h"
#include "compare/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace reflet::octaves_test {
namespace {

using Pattern = std::function<double(uint32_t x, uint32_t y)>;

FloatImage imageOf(uint32_t width, uint32_t height, const Pattern& pattern) {
    FloatImage image{width, height, {"Y"}, {}};
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            image.data.push_back(static_cast<float>(pattern(x, y)));
        }
    }
    return image;
}

FloatImage noise(uint32_t width, uint32_t height, size_t channels, uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    FloatImage image{width, height, std::vector<std::string>(channels, "c"), {}};
    image.data.resize(size_t{width} * height * channels);
    std::ranges::generate(image.data, [&] { return normal(random); });
    return image;
}

FloatImage black(const FloatImage& like) {
    return {like.width, like.height, like.channels, std::vector<float>(like.data.size(), 0.0F)};
}

double total(const OctaveErrors& errors) {
    return std::accumulate(errors.begin(), errors.end(), 0.0);
}

/// Of the pattern, over a black reference, in all octaves: parts of 1.
OctaveErrors shares(const FloatImage& image) {
    OctaveErrors errors = errorByOctave(image, black(image), {});
    const double sum = total(errors);
    for (double& error : errors) {
        error /= sum;
    }
    return errors;
}

// Cosines that mirrored borders continue: their wavelengths divide twice the size.
FloatImage waves(double wavelength, bool alongX, bool alongY) {
    return imageOf(192, 192, [&](uint32_t x, uint32_t y) {
        const auto wave = [&](uint32_t at) { return std::cos(2.0 * pi * (at + 0.5) / wavelength); };
        return (alongX ? wave(x) : 1.0) * (alongY ? wave(y) : 1.0);
    });
}

TEST(Octaves, AWaveIsInItsOctave) {
    const std::vector<std::pair<bool, bool>> directions{{true, false}, {false, true}, {true, true}};
    for (size_t octave = 0; octave < octaveCount; ++octave) {
        const double wavelength = 3.0 * std::pow(2.0, octave);
        for (const auto& [alongX, alongY] : directions) {
            EXPECT_GT(shares(waves(wavelength, alongX, alongY)).at(octave), 0.97) << wavelength << alongX << alongY;
        }
    }
}

TEST(Octaves, AWaveAtALimitIsHalfInEither) {
    for (size_t octave = 0; octave + 1 < octaveCount; ++octave) {
        const OctaveErrors parts = shares(waves(4.0 * std::pow(2.0, octave), true, false));
        EXPECT_NEAR(parts.at(octave), 0.5, 0.01) << octave;
        EXPECT_NEAR(parts.at(octave + 1), 0.5, 0.01) << octave;
    }
}

TEST(Octaves, TheShorterOfTwoWavelengthsCounts) {
    const FloatImage both = imageOf(192, 192, [](uint32_t x, uint32_t y) {
        return std::cos(2.0 * pi * (x + 0.5) / 12.0) * std::cos(2.0 * pi * (y + 0.5) / 96.0);
    });
    EXPECT_GT(shares(both)[2], 0.97);
}

// Its power is that of the area in the plane of frequencies: an octave has three quarters of what finer ones leave.
TEST(Octaves, WhiteNoiseHasAQuarterOfThePowerInEachCoarserOctave) {
    const OctaveErrors parts = shares(noise(512, 512, 1, 1));
    double rest = 1.0;
    for (size_t octave = 0; octave < 4; ++octave) {
        EXPECT_NEAR(parts.at(octave), 0.75 * rest, 0.06 * rest) << octave;
        rest /= 4.0;
    }
}

TEST(Octaves, AConstantErrorIsInTheCoarsestAlone) {
    const FloatImage reference = imageOf(37, 23, [](uint32_t, uint32_t) { return 2.0; });
    const FloatImage image = imageOf(37, 23, [](uint32_t, uint32_t) { return 2.5; });
    const OctaveErrors errors = errorByOctave(image, reference, {});
    EXPECT_NEAR(errors.back(), 0.25 / 4.01, 1e-9);
    for (size_t octave = 0; octave + 1 < octaveCount; ++octave) {
        EXPECT_LT(errors.at(octave), 1e-12) << octave;
    }
    EXPECT_EQ(total(errorByOctave(image, image, {})), 0.0);
}

TEST(Octaves, AllSumToTheRelativeMseAndNoneIsNegative) {
    const std::vector<std::pair<uint32_t, uint32_t>> sizes{{1, 1}, {1, 50}, {7, 1}, {5, 3}, {65, 43}, {320, 181}};
    for (const auto& [width, height] : sizes) {
        for (const size_t channels : {1U, 3U}) {
            CompareOptions options;
            options.octaves = true;
            const FloatImage image = noise(width, height, channels, 1);
            const FloatImage reference = noise(width, height, channels, 2);
            for (const bool masked : {false, true}) {
                options.mask.assign(masked ? size_t{width} * height : 0, true);
                for (size_t i = 1; i < options.mask.size(); i += 2 + i % 3) {
                    options.mask[i] = false;
                }
                const Difference d = compareImages(image, reference, options).difference;
                EXPECT_NEAR(total(d.octaves), d.relativeMse, 1e-6 * d.relativeMse) << width << 'x' << height;
                EXPECT_GE(*std::ranges::min_element(d.octaves), 0.0);
            }
        }
    }
}

TEST(Octaves, AreComputedOnDemand) {
    const FloatImage image = noise(8, 8, 1, 1);
    EXPECT_EQ(total(compareImages(image, black(image), {}).difference.octaves), 0.0);
}

TEST(Octaves, TheLargestValuesDoNotOverflow) {
    const FloatImage image =
        imageOf(16, 16, [](uint32_t x, uint32_t) { return 3e38 * std::cos(2.0 * pi * (x + 0.5) * 12.0 / 32.0); });
    const OctaveErrors errors = errorByOctave(image, black(image), {});
    EXPECT_NEAR(total(errors) / 4.5e78, 1.0, 1e-5);
    EXPECT_NEAR(errors[0] / 4.5e78, 1.0, 1e-3);
}

}  // namespace
}  // namespace reflet::octaves_test
