// Metrics of images small enough to be worked out by hand, masks, and invalid input.
#include "compare/compare.h"

#include "base/color.h"
#include "compare/color.h"
#include "compare/heat_map.h"
#include "unit/message_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace reflet::compare_test {
namespace {

using test::messageOf;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

FloatImage grey(uint32_t width, std::vector<float> values) {
    const auto height = static_cast<uint32_t>(values.size() / width);
    return {width, height, {"Y"}, std::move(values)};
}

FloatImage colors(uint32_t width, std::vector<float> values) {
    const auto height = static_cast<uint32_t>(values.size() / 3 / width);
    return {width, height, {"R", "G", "B"}, std::move(values)};
}

Difference difference(const FloatImage& picture, const FloatImage& reference, ImageKind kind = ImageKind::linear) {
    CompareOptions options;
    options.kind = kind;
    return compareImages(picture, reference, options).difference;
}

std::string complaint(const FloatImage& picture, const FloatImage& reference, const CompareOptions& options = {}) {
    return messageOf([&] { compareImages(picture, reference, options); });
}

TEST(Compare, EqualPicturesHaveNoDifferenceAndInfinitePsnr) {
    const FloatImage image = colors(2, {0.5F, 0, 2, 1, 1, 1});
    const Difference d = difference(image, image);
    EXPECT_EQ(d.relativeMse, 0.0);
    EXPECT_EQ(d.mean, 0.0);
    EXPECT_EQ(d.max, 0.0);
    EXPECT_EQ(d.flip, 0.0);
    EXPECT_TRUE(std::isinf(d.psnr) && d.psnr > 0.0);
    EXPECT_EQ(d.pixels, 2U);
}

// Differences 0.5, 0, 1, 0 against a reference of 0.5, 0, 2, 1: squares 0.25 and 1.
TEST(Compare, MetricsOfLinearPicturesAreAsWorkedOutByHand) {
    const Difference d = difference(grey(2, {1, 0, 1, 1}), grey(2, {0.5F, 0, 2, 1}));
    EXPECT_NEAR(d.relativeMse, (0.25 / 0.26 + 1.0 / 4.01) / 4.0, 1e-9);
    EXPECT_NEAR(d.psnr, 10.0 * std::log10(4.0 / (1.25 / 4.0)), 1e-9);  // the reference's largest value is 2
    EXPECT_NEAR(d.mean, 1.5 / 4.0, 1e-9);
    EXPECT_EQ(d.max, 1.0);
    EXPECT_EQ(d.pixels, 4U);
}

TEST(Compare, ThePeakOfDisplayPicturesIsOne) {
    const Difference d = difference(grey(2, {0.5F, 0.25F}), grey(2, {0.5F, 0.5F}), ImageKind::display);
    EXPECT_NEAR(d.psnr, 10.0 * std::log10(1.0 / (0.0625 / 2.0)), 1e-9);
}

TEST(Compare, ABlackReferenceGivesAFinitePsnr) {
    EXPECT_NEAR(difference(grey(1, {0.1F}), grey(1, {0})).psnr, 20.0, 1e-5);
}

TEST(Compare, NegativeValuesCountAsTheyAreInAllButFlip) {
    const Difference d = difference(grey(1, {-1}), grey(1, {-3}));
    EXPECT_EQ(d.mean, 2.0);
    EXPECT_NEAR(d.relativeMse, 4.0 / 9.01, 1e-9);
    EXPECT_EQ(d.flip, 0.0);
}

TEST(Compare, BiasIsTheRatioOfTheMeansLessOneAndKeepsItsSign) {
    EXPECT_NEAR(difference(grey(2, {1, 2}), grey(2, {1, 1})).bias, 0.5, 1e-9);
    EXPECT_NEAR(difference(grey(2, {0, 1}), grey(2, {2, 2})).bias, -0.75, 1e-9);
    EXPECT_EQ(difference(grey(1, {0}), grey(1, {0})).bias, 0.0);
}

TEST(Compare, EveryChannelHasTheSameWeight) {
    const Difference d = difference(colors(1, {1, 2, 3}), colors(1, {1, 1, 1}));
    EXPECT_NEAR(d.mean, 1.0, 1e-9);
    EXPECT_NEAR(d.relativeMse, 5.0 / 3.0 / 1.01, 1e-9);
}

TEST(Compare, GreyIsTheColorWithThreeEqualChannels) {
    for (const ImageKind kind : {ImageKind::linear, ImageKind::display}) {
        const Difference one = difference(grey(2, {0.2F, 0.9F}), grey(2, {0.3F, 0.7F}), kind);
        const Difference three = difference(colors(2, {0.2F, 0.2F, 0.2F, 0.9F, 0.9F, 0.9F}),
                                            colors(2, {0.3F, 0.3F, 0.3F, 0.7F, 0.7F, 0.7F}), kind);
        EXPECT_EQ(one.flip, three.flip);
        EXPECT_GT(one.flip, 0.0);
        EXPECT_NEAR(one.relativeMse, three.relativeMse, 1e-9);
        EXPECT_NEAR(one.psnr, three.psnr, 1e-6);
    }
}

// Display values are decoded to linear first.
TEST(Compare, FlipOfDisplayPicturesIsThatOfTheirLinearColors) {
    const float a = encodeSrgb(labToLinear({42.0F, 0.0F, 0.0F}).x);
    const float b = encodeSrgb(labToLinear({50.0F, 0.0F, 0.0F}).x);
    EXPECT_NEAR(difference(grey(2, {a, a}), grey(2, {b, b}), ImageKind::display).flip, 0.24668, 1e-4);
}

TEST(Compare, OnlyTheMasksPixelsCountButTheFlipImageIsComplete) {
    const FloatImage picture = grey(4, {0, 5, 0, 1});
    const FloatImage reference = grey(4, {0, 1, 0, 2});
    CompareOptions options;
    options.mask = {true, false, false, true};
    const Comparison masked = compareImages(picture, reference, options);
    EXPECT_EQ(masked.difference.pixels, 2U);
    EXPECT_EQ(masked.difference.max, 1.0);
    EXPECT_EQ(masked.difference.mean, 0.5);
    options.mask.clear();
    const Comparison whole = compareImages(picture, reference, options);
    EXPECT_EQ(whole.flip.data, masked.flip.data);
    EXPECT_NEAR(masked.difference.flip, (whole.flip.data[0] + whole.flip.data[3]) / 2.0, 1e-7);
}

TEST(Compare, PicturesOfDifferentSizesOrChannelsAreNamed) {
    CompareOptions options;
    options.imageName = "a.exr";
    EXPECT_EQ(complaint(grey(2, {0, 0}), grey(1, {0, 0}), options),
              "a.exr is 2x1, but the reference is 1x2: only images of the same size can be compared");
    EXPECT_EQ(complaint(grey(1, {0}), colors(1, {0, 0, 0}), options),
              "a.exr has the channels Y, but the reference has R, G, B: only images with the same number of channels "
              "can be compared");
    const FloatImage two{1, 1, {"X", "Y"}, {0, 0}};
    EXPECT_EQ(complaint(two, two, options),
              "a.exr has the channels X, Y: only images with 1 or 3 channels can be compared");
    EXPECT_EQ(complaint(grey(1, {}), grey(1, {}), options), "a.exr has no pixels");
}

TEST(Compare, NanAndInfinityAreReportedWithTheirLocation) {
    const FloatImage good = colors(2, std::vector<float>(12, 1.0F));
    FloatImage bad = good;
    bad.data[3 * 3 + 1] = nan;
    EXPECT_EQ(complaint(bad, good), "the image: NaN at pixel (1, 1), channel G");
    EXPECT_EQ(complaint(good, bad), "the reference: NaN at pixel (1, 1), channel G");
    bad.data[2] = -infinity;
    bad.data[5] = infinity;
    EXPECT_EQ(complaint(good, bad),
              "the reference: infinity at pixel (0, 0), channel B, and 2 more that are NaN or infinity");
}

TEST(Compare, AMaskOfTheWrongSizeOrWithNothingInItIsAnError) {
    CompareOptions options;
    options.mask = {true};
    EXPECT_EQ(complaint(grey(2, {0, 0}), grey(2, {0, 0}), options), "the mask has 1 pixels, but the images have 2");
    options.mask = {false, false};
    EXPECT_EQ(complaint(grey(2, {0, 0}), grey(2, {0, 0}), options), "the mask leaves no pixels to compare");
}

TEST(Compare, PixelsPerDegreeHaveARange) {
    CompareOptions options;
    for (const float wrong : {0.0F, -1.0F, 1001.0F, nan, infinity}) {
        options.pixelsPerDegree = wrong;
        EXPECT_NE(complaint(grey(1, {0}), grey(1, {0}), options).find("must be 1 to 1000"), std::string::npos) << wrong;
    }
    for (const float right : {1.0F, 1000.0F}) {
        options.pixelsPerDegree = right;
        EXPECT_EQ(complaint(grey(1, {0}), grey(1, {1}), options), "no error");
    }
}

TEST(Compare, EveryMetricHasANameAndIsItsValue) {
    const Difference d{1.0, 2.0, 3.0, 4.0, 5.0, 6};
    std::vector<std::string_view> names;
    std::vector<double> values;
    for (const Metric& metric : metrics()) {
        names.push_back(metric.name);
        values.push_back(metric.value(d));
        EXPECT_EQ(metric.largeIsGood, metric.name == "psnr");
    }
    EXPECT_EQ(names, (std::vector<std::string_view>{"relative_mse", "psnr", "flip", "mean", "bias", "max"}));
    EXPECT_EQ(values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

vec3 labOf(const Bitmap& bitmap, size_t pixel) {
    vec3 linear(0.0F);
    for (int c = 0; c < 3; ++c) {
        linear[c] = decodeSrgb(static_cast<float>(bitmap.data[3 * pixel + static_cast<size_t>(c)]) / 255.0F);
    }
    return linearToLab(linear);
}

TEST(HeatMap, GetsLighterAndChangesColorByEqualSteps) {
    constexpr size_t steps = 32;
    FloatImage ramp{steps + 1, 1, {"Y"}, {}};
    for (size_t i = 0; i <= steps; ++i) {
        ramp.data.push_back(static_cast<float>(i) / steps);
    }
    const Bitmap map = heatMap(ramp);
    ASSERT_EQ(map.data.size(), 3 * (steps + 1));
    for (size_t i = 0; i <= steps; ++i) {
        EXPECT_NEAR(labOf(map, i).x, 4.0F + 92.0F * ramp.data[i], 1.0F) << i;  // within rounding to 8 bits
    }
    for (size_t i = 0; i < steps; ++i) {
        EXPECT_NEAR(glm::distance(labOf(map, i), labOf(map, i + 1)) * steps, 213.0F, 45.0F) << i;
    }
}

TEST(HeatMap, ClampsValuesOutsideOfZeroToOne) {
    const Bitmap map = heatMap({4, 1, {"Y"}, {-1.0F, 0.0F, 1.0F, 7.0F}});
    EXPECT_EQ(labOf(map, 0), labOf(map, 1));
    EXPECT_EQ(labOf(map, 2), labOf(map, 3));
    EXPECT_EQ(map.channels, 3U);
}

}  // namespace
}  // namespace reflet::compare_test
