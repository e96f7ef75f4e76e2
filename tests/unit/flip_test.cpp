// FLIP against values worked out by hand and against a slow reference implementation (flip_by_definition.py), and its
// required properties.
#include "compare/flip.h"

#include "compare/color.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace reflet::flip_test {
namespace {

constexpr float ppd = 67.0F;

using Colors = std::function<vec3(uint32_t x, uint32_t y)>;

Planes3 paint(uint32_t width, uint32_t height, const Colors& colors) {
    Planes3 planes = makePlanes3(width, height);
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const vec3 color = colors(x, y);
            for (int c = 0; c < 3; ++c) {
                planes[static_cast<size_t>(c)].row(y)[x] = color[c];
            }
        }
    }
    return planes;
}

Planes3 constant(const vec3& color) {
    return paint(40, 30, [&](uint32_t, uint32_t) { return color; });
}

float grey(float lightness) {
    return labToLinear({lightness, 0.0F, 0.0F}).x;
}

float mean(const Plane& plane) {
    return static_cast<float>(std::accumulate(plane.data.begin(), plane.data.end(), 0.0) /
                              static_cast<double>(plane.data.size()));
}

float largest(const Plane& plane) {
    return *std::ranges::max_element(plane.data);
}

// A smooth colour image, 0..1.
vec3 scenery(uint32_t x, uint32_t y) {
    const auto wave = [&](float f) {
        return 0.5F + 0.4F * std::sin(f * static_cast<float>(x) + 0.2F * f * static_cast<float>(y));
    };
    return {wave(0.11F), wave(0.17F), wave(0.23F)};
}

// -1..1, deterministic per pixel and channel.
float noise(uint32_t x, uint32_t y, uint32_t c) {
    uint32_t h = x * 0x9E3779B1U ^ y * 0x85EBCA77U ^ c * 0xC2B2AE3DU;
    h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
    h = (h ^ (h >> 12U)) * 0x297A2D39U;
    return static_cast<float>(h >> 8U) / 8388608.0F - 1.0F;
}

Planes3 noisy(float amount, float scale = 1.0F) {
    return paint(64, 48, [&](uint32_t x, uint32_t y) {
        return glm::clamp(scenery(x, y) + amount * vec3(noise(x, y, 0), noise(x, y, 1), noise(x, y, 2)), 0.0F, 1.0F) *
               scale;
    });
}

void expectConstant(const Plane& flip, float value, float tolerance) {
    for (const float v : flip.data) {
        ASSERT_NEAR(v, value, tolerance);
    }
}

TEST(Flip, OfAPictureWithItselfIsZeroEverywhere) {
    expectConstant(ldrFlip(noisy(0.2F), noisy(0.2F), ppd), 0.0F, 0.0F);
    expectConstant(hdrFlip(noisy(0.2F, 50.0F), noisy(0.2F, 50.0F), ppd), 0.0F, 0.0F);
}

// Constant images have no edges, and the contrast sensitivity filter does not change them, so that FLIP is the remapped
// distance d of the two colours. The largest distance is that of green and blue, in Hunt-adjusted Lab (87.736, -75.610,
// 72.981) and (32.298, 25.578, -34.836): |55.438| + |(-101.188, 107.818)| = 203.302, to the power of 0.7: 41.276.
// Distances below 0.4 of it, 16.510, are mapped to 0..0.95, larger ones to 0.95..1.
TEST(Flip, OfGreenAndBlueIsOne) {
    expectConstant(ldrFlip(constant({0, 1, 0}), constant({0, 0, 1}), ppd), 1.0F, 1e-5F);
}

// d = 100^0.7 = 25.119: 0.95 + 0.05 (25.119 - 16.510) / (41.276 - 16.510) = 0.96738.
TEST(Flip, OfBlackAndWhiteIsAsWorkedOutByHand) {
    expectConstant(ldrFlip(constant(vec3(0.0F)), constant(vec3(1.0F)), ppd), 0.96738F, 2e-5F);
}

// Greys with L* 42 and 50 are 8 apart: 8^0.7 = 4.2871, times 0.95 / 16.510 is 0.24668.
TEST(Flip, OfTwoGreysIsAsWorkedOutByHand) {
    expectConstant(ldrFlip(constant(vec3(grey(42.0F))), constant(vec3(grey(50.0F))), ppd), 0.24668F, 5e-5F);
}

// Red is (53.237, 42.639, 35.775): |34.499| + |(118.249, 37.206)| = 158.464, to the power of 0.7: 34.670;
// 0.95 + 0.05 (34.670 - 16.510) / 24.766 = 0.98666.
TEST(Flip, OfRedAndGreenIsAsWorkedOutByHand) {
    expectConstant(ldrFlip(constant({1, 0, 0}), constant({0, 1, 0}), ppd), 0.98666F, 2e-5F);
}

// On either side of a step from 0 to h the edge detector's negative weights cover only 0 and its positive ones only h:
// its response is h. The point detector is symmetric, and its response is smaller.
TEST(Flip, AnEdgeOfHeightHInOneImageOnlyIsAFeatureOfRootOfHOverRootTwo) {
    for (const float h : {1.0F, 0.3F}) {
        Plane step(60, 40);
        for (size_t i = 0; i < step.data.size(); ++i) {
            step.data[i] = i % 60 < 30 ? 0.0F : h;
        }
        const Plane feature = featureDifference(step, Plane(60, 40), ppd);
        EXPECT_NEAR(feature.row(20)[29], std::sqrt(h / std::sqrt(2.0F)), 1e-4F);
        EXPECT_NEAR(feature.row(20)[30], std::sqrt(h / std::sqrt(2.0F)), 1e-4F);
        EXPECT_NEAR(feature.row(20)[5], 0.0F, 1e-3F);
    }
}

// White on black inverted to black on white has the same edges.
TEST(Flip, SwappedSidesOfAnEdgeAreAColorDifferenceAndNoFeature) {
    const auto half = [](bool left) {
        return paint(80, 20, [=](uint32_t x, uint32_t) { return vec3((x < 40) == left ? 1.0F : 0.0F); });
    };
    const Plane flip = ldrFlip(half(true), half(false), ppd);
    EXPECT_NEAR(flip.row(10)[2], 0.96738F, 1e-4F);
    EXPECT_NEAR(flip.row(10)[77], 0.96738F, 1e-4F);
    EXPECT_LT(flip.row(10)[39], 0.96738F);
}

// The contrast sensitivity filter leaves 0.15 of a single pixel: 0.2 + 0.15 · 0.8 = 0.32 is 11.5 L* above the
// surrounding grey, a colour difference of 11.5^0.7 · 0.95 / 16.51 = 0.32. FLIP = color^(1 - feature) is more.
TEST(Flip, AFireflyStandsOut) {
    const auto grey = constant(vec3(0.2F));
    Planes3 firefly = grey;
    for (Plane& plane : firefly) {
        plane.row(15)[20] = 1.0F;
    }
    const Plane flip = ldrFlip(firefly, grey, ppd);
    EXPECT_EQ(largest(flip), flip.row(15)[20]);
    EXPECT_GT(flip.row(15)[20], 0.37F);
    EXPECT_LT(flip.row(2)[2], 1e-3F);
}

// At 67 pixels per degree the contrast sensitivity filter passes 3e-5 of a one-pixel checkerboard.
TEST(Flip, ACheckerboardTooFineForTheEyeIsItsMeanGreyButNotUpClose) {
    const Planes3 board = paint(60, 60, [](uint32_t x, uint32_t y) { return vec3((x + y) % 2 == 0 ? 1.0F : 0.0F); });
    const Planes3 grey = paint(60, 60, [](uint32_t, uint32_t) { return vec3(0.5F); });
    EXPECT_LT(ldrFlip(board, grey, ppd).row(30)[30], 0.01F);
    EXPECT_GT(ldrFlip(board, grey, 10.0F).row(30)[30], 0.3F);
}

TEST(Flip, IsSymmetric) {
    EXPECT_EQ(ldrFlip(noisy(0.1F), noisy(0.3F), ppd).data, ldrFlip(noisy(0.3F), noisy(0.1F), ppd).data);
}

TEST(Flip, IsBetweenZeroAndOne) {
    const Planes3 a =
        paint(50, 50, [](uint32_t x, uint32_t y) { return vec3(noise(x, y, 0) > 0.0F, noise(x, y, 1) > 0.5F, 0); });
    const Planes3 b = paint(50, 50, [](uint32_t x, uint32_t y) { return vec3(0, x > 20, noise(x, y, 2) > 0.0F); });
    for (const float degree : {1.0F, 20.0F, ppd, 300.0F}) {
        for (const float v : ldrFlip(a, b, degree).data) {
            ASSERT_TRUE(v >= 0.0F && v <= 1.0F) << v;
        }
    }
}

TEST(Flip, GrowsWithNoise) {
    float lastDisplay = 0.0F;
    float lastRadiance = 0.0F;
    for (const float amount : {0.01F, 0.03F, 0.1F, 0.3F}) {
        const float display = mean(ldrFlip(noisy(amount), noisy(0.0F), ppd));
        const float radiance = mean(hdrFlip(noisy(amount, 20.0F), noisy(0.0F, 20.0F), ppd));
        EXPECT_GT(display, lastDisplay);
        EXPECT_GT(radiance, lastRadiance);
        lastDisplay = display;
        lastRadiance = radiance;
    }
}

TEST(Flip, OfAPictureOfOnePixelIsThatOfItsColors) {
    Planes3 black = makePlanes3(1, 1);
    Planes3 white = paint(1, 1, [](uint32_t, uint32_t) { return vec3(1.0F); });
    EXPECT_NEAR(ldrFlip(black, white, ppd).data[0], 0.96738F, 2e-5F);
}

// The output of flip_by_definition.py for the same two images.
TEST(Flip, AgreesWithTheDefinitionWithoutSeparatedFilters) {
    const auto pattern = [](float phase) {
        return paint(24, 16, [=](uint32_t x, uint32_t y) {
            const auto wave = [&](float c) {
                return 0.5F + 0.45F * std::sin(phase + 0.4F * static_cast<float>(x) * c + 0.3F * static_cast<float>(y));
            };
            return x == 9 && phase == 0.0F ? vec3(0.05F) : vec3(wave(1.0F), wave(2.0F), wave(3.0F));
        });
    };
    const Plane flip = ldrFlip(pattern(0.0F), pattern(0.3F), 30.0F);
    EXPECT_NEAR(mean(flip), 0.442102F, 1e-5F);
    EXPECT_NEAR(largest(flip), 0.975057F, 1e-4F);
    EXPECT_NEAR(flip.row(5)[9], 0.956608F, 1e-4F);
    EXPECT_NEAR(flip.row(0)[0], 0.375355F, 1e-4F);
}

TEST(HdrFlip, AgreesWithTheDefinitionWithoutSeparatedFilters) {
    const auto pattern = [](float phase) {
        return paint(24, 16, [=](uint32_t x, uint32_t y) {
            const auto wave = [&](float c) {
                return std::exp(2.5F * std::cos(phase + 0.3F * static_cast<float>(x) + 0.5F * c) +
                                0.2F * static_cast<float>(y));
            };
            return vec3(wave(0.0F), wave(1.0F), wave(2.0F));
        });
    };
    const ExposureRange range = exposureRange(pattern(0.0F));
    EXPECT_NEAR(range.start, -6.712230, 1e-5);
    EXPECT_NEAR(range.stop, -1.883358, 1e-5);
    EXPECT_EQ(range.count, 5U);
    const Plane flip = hdrFlip(pattern(0.1F), pattern(0.0F), 30.0F);
    EXPECT_NEAR(mean(flip), 0.261850F, 1e-5F);
    EXPECT_NEAR(largest(flip), 0.374745F, 1e-4F);
    EXPECT_NEAR(flip.row(5)[9], 0.096117F, 1e-4F);
    EXPECT_NEAR(flip.row(0)[0], 0.217549F, 1e-4F);
}

TEST(HdrFlip, TheFirstExposureShowsTheLargestLuminanceAsBrightAndTheLastTheMedian) {
    const Planes3 reference =
        paint(5, 1, [](uint32_t x, uint32_t) { return vec3(std::exp2(static_cast<float>(x) * 2.0F)); });
    const ExposureRange range = exposureRange(reference);
    EXPECT_NEAR(displayTone(static_cast<float>(256.0 * std::exp2(range.at(0)))), 0.85F, 1e-4F);
    EXPECT_NEAR(displayTone(static_cast<float>(16.0 * std::exp2(range.at(range.count - 1)))), 0.85F, 1e-4F);
    EXPECT_EQ(range.count, 4U);
}

TEST(HdrFlip, AReferenceOfOneLuminanceHasOneExposureAndSoDoesABlackOne) {
    EXPECT_EQ(exposureRange(constant(vec3(3.0F))).count, 1U);
    EXPECT_EQ(exposureRange(constant(vec3(0.0F))).count, 1U);
    EXPECT_EQ(exposureRange(constant(vec3(-1.0F))).count, 1U);
    EXPECT_EQ(exposureRange(constant(vec3(0.0F))).at(0), 0.0);
}

TEST(HdrFlip, WhereMoreThanHalfIsBlackTheMedianIsThatOfTheRest) {
    const Planes3 reference =
        paint(10, 1, [](uint32_t x, uint32_t) { return vec3(x < 7 ? 0.0F : std::exp2(static_cast<float>(x))); });
    const ExposureRange range = exposureRange(reference);
    EXPECT_NEAR(range.stop - range.start, 1.0, 1e-5);  // 2^9 and 2^8
}

// The exposures scale with the reference.
TEST(HdrFlip, DoesNotDependOnTheUnitOfRadiance) {
    const Plane flip = hdrFlip(noisy(0.2F), noisy(0.0F), ppd);
    for (const float scale : {0.001F, 4000.0F}) {
        const Plane scaled = hdrFlip(noisy(0.2F, scale), noisy(0.0F, scale), ppd);
        for (size_t i = 0; i < flip.data.size(); ++i) {
            ASSERT_NEAR(scaled.data[i], flip.data[i], 2e-3F) << scale;
        }
    }
}

TEST(HdrFlip, SeesAnErrorInTheDarkThatDisplayFlipAtTheBrightestExposureDoesNot) {
    const auto picture = [](float dark) {
        return paint(40, 40, [=](uint32_t x, uint32_t) { return vec3(x < 30 ? dark : 1000.0F); });
    };
    EXPECT_GT(mean(hdrFlip(picture(0.5F), picture(1.0F), ppd)), 0.2F);
}

TEST(HdrFlip, SurvivesTheSmallestAndTheLargestRadiance) {
    const Planes3 reference = paint(20, 20, [](uint32_t x, uint32_t) {
        return vec3(x == 0 ? 3e38F : x < 15 ? 1e-38F : 0.0F);
    });
    const Planes3 picture = paint(20, 20, [](uint32_t x, uint32_t) { return vec3(x == 0 ? -3e38F : 1e-37F); });
    for (const float v : hdrFlip(picture, reference, ppd).data) {
        ASSERT_TRUE(v >= 0.0F && v <= 1.0F) << v;
    }
}

}  // namespace
}  // namespace reflet::flip_test
