// Blue noise: the masks that the build made, and small ones made here. The masks are the same in every build: bounds
// are those measured, and some slack.
#include "noise/blue_noise.h"

#include "noise/void_and_cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet::blue_noise_test {
namespace {

constexpr uint32_t side = blueNoiseSide;
constexpr uint32_t slices = blueNoiseSlices;
constexpr double whiteVariance = 1.0 / 12.0;

class BlueNoiseMask : public testing::TestWithParam<uint32_t> {
protected:
    // -0.5 to 0.5; the mask goes on beyond its edges.
    static double value(uint32_t x, uint32_t y, uint32_t slice) {
        const uint32_t texel = blueNoise()[(slice % slices * side + y % side) * side + x % side];
        return ((texel >> GetParam()) & 0xffffU) / 65536.0 - 0.5;
    }

    /// Variance of means of boxes, relative to that of as many independent numbers.
    static double varianceOfBoxes(uint32_t width, uint32_t height, uint32_t frames) {
        double sum = 0.0;
        for (uint32_t i = 0; i < side * side * slices; ++i) {
            double box = 0.0;
            for (uint32_t j = 0; j < width * height * frames; ++j) {
                box += value(i % side + j % width, i / side % side + j / width % height,
                             i / side / side + j / width / height);
            }
            sum += box * box / (width * height * frames);
        }
        return sum / (side * side * slices) / whiteVariance;
    }
};

TEST_P(BlueNoiseMask, HasEveryValueOnceInEachSlice) {
    for (uint32_t slice = 0; slice < slices; ++slice) {
        std::vector<double> values;
        for (uint32_t i = 0; i < side * side; ++i) {
            values.push_back(value(i % side, i / side, slice));
        }
        std::ranges::sort(values);
        for (uint32_t i = 0; i < side * side; ++i) {
            ASSERT_NEAR(values[i], (i + 0.5) / (side * side) - 0.5, 0.5 / 65536.0);
        }
    }
}

TEST_P(BlueNoiseMask, LosesMostOfItsVarianceInABlur) {
    EXPECT_LT(varianceOfBoxes(3, 3, 1), 0.27);
    EXPECT_LT(varianceOfBoxes(5, 5, 1), 0.2);
    EXPECT_LT(varianceOfBoxes(7, 7, 1), 0.13);
}

TEST_P(BlueNoiseMask, LosesMostOfItsVarianceOverSuccessiveFramesAtAPixel) {
    EXPECT_LT(varianceOfBoxes(1, 1, 4), 0.21);
    EXPECT_LT(varianceOfBoxes(1, 1, 8), 0.12);
}

TEST_P(BlueNoiseMask, LosesNearlyAllOfItInSpaceAndTimeTogether) {
    EXPECT_LT(varianceOfBoxes(3, 3, 4), 0.06);
}

INSTANTIATE_TEST_SUITE_P(BothHalves, BlueNoiseMask, testing::Values(0U, 16U),
                         [](const auto& half) { return half.param == 0 ? "low" : "high"; });

TEST(BlueNoise, IsTwoMasksThatKnowNothingOfOneAnother) {
    double sum = 0.0;
    for (const uint32_t texel : blueNoise()) {
        sum += ((texel & 0xffffU) / 65536.0 - 0.5) * ((texel >> 16U) / 65536.0 - 0.5);
    }
    const auto count = static_cast<double>(blueNoise().size());
    EXPECT_LT(std::abs(sum / count / whiteVariance), 5.0 / std::sqrt(count));
}

TEST(VoidAndCluster, RanksEveryCellOfASliceOnceWhateverTheSize) {
    for (const auto& [width, frames] : {std::pair(2U, 2U), std::pair(5U, 3U), std::pair(16U, 4U), std::pair(20U, 7U)}) {
        const auto ranks = voidAndClusterRanks(width, frames, 3);
        ASSERT_EQ(ranks.size(), width * width * frames);
        for (uint32_t slice = 0; slice < frames; ++slice) {
            const size_t cells = size_t{width} * width;
            const std::span ofSlice = std::span(ranks).subspan(slice * cells, cells);
            std::vector<uint32_t> sorted(ofSlice.begin(), ofSlice.end());
            std::ranges::sort(sorted);
            for (uint32_t i = 0; i < sorted.size(); ++i) {
                ASSERT_EQ(sorted[i], i) << width << " wide, slice " << slice;
            }
        }
    }
}

TEST(VoidAndCluster, MakesTheSameMaskOfTheSameSeedAndAnotherOfAnother) {
    EXPECT_EQ(voidAndClusterRanks(16, 4, 1), voidAndClusterRanks(16, 4, 1));
    EXPECT_NE(voidAndClusterRanks(16, 4, 1), voidAndClusterRanks(16, 4, 2));
}

TEST(VoidAndCluster, KeepsCellsOfOneThresholdApartAcrossTheEdgesToo) {
    constexpr int width = 32;
    constexpr int frames = 8;
    const auto ranks = voidAndClusterRanks(width, frames, 1);
    const auto isOn = [&](int x, int y, int slice) {
        return ranks[((slice + frames) % frames * width + (y + width) % width) * width + (x + width) % width] <
               width * width / 16;
    };
    for (int i = 0; i < width * width * frames; ++i) {
        const int x = i % width;
        const int y = i / width % width;
        const int slice = i / width / width;
        for (int j = 0; isOn(x, y, slice) && j < 9; ++j) {  // a sixteenth: 4 pixels apart were they on a grid
            ASSERT_FALSE(j != 4 && isOn(x + j % 3 - 1, y + j / 3 - 1, slice)) << x << ", " << y << ", " << slice;
        }
        ASSERT_FALSE(isOn(x, y, slice) && (isOn(x, y, slice - 1) || isOn(x, y, slice + 1)));
    }
}

}  // namespace
}  // namespace reflet::blue_noise_test
