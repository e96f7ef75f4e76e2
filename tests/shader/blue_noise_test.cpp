// blue_noise.glsl: the strata of the sequence, its shift, and the order of mask look-ups.
#include "shader/blue_noise_test.h"

#include "noise/blue_noise.h"
#include "shader/harness.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace reflet::test::blue_noise_test {
namespace {

class BlueNoisePoints : public ShaderTest {
protected:
    static std::vector<BlueNoiseSample> sample(const std::vector<BlueNoiseCase>& cases) {
        return mapOnDevice<BlueNoiseSample>("blue_noise_test.comp", cases);
    }

    static std::vector<BlueNoiseSample> raysOfAPixel(uint32_t count, uvec2 pixel, uint32_t frameNumber) {
        std::vector<BlueNoiseCase> cases;
        for (uint32_t i = 0; i < count; ++i) {
            cases.push_back({pixel, 5, frameNumber, i, count});
        }
        return sample(cases);
    }

    /// One point in each of 2^columns · 2^rows boxes.
    static void expectOneInEachBox(const std::vector<vec2>& points, uint32_t columns, uint32_t rows) {
        std::set<std::pair<uint32_t, uint32_t>> boxes;
        for (const vec2& p : points) {
            boxes.emplace(static_cast<uint32_t>(std::ldexp(p.x, static_cast<int>(columns))),
                          static_cast<uint32_t>(std::ldexp(p.y, static_cast<int>(rows))));
        }
        EXPECT_EQ(boxes.size(), points.size()) << columns << " + " << rows;
        EXPECT_LT(boxes.rbegin()->first, 1U << columns);
    }
};

TEST_F(BlueNoisePoints, OfEveryPowerOfTwoFillEveryShapeOfBoxes) {
    const auto samples = raysOfAPixel(4096, uvec2(0), 0);
    for (uint32_t k = 0; k <= 8; ++k) {
        for (uint32_t first = 0; first < 4096; first += 1U << k) {
            std::vector<vec2> points;
            for (uint32_t i = first; i < first + (1U << k); ++i) {
                points.push_back(vec2(samples[i].sobol >> 8U) / 16777216.0F);
            }
            for (uint32_t columns = 0; columns <= k; ++columns) {
                expectOneInEachBox(points, columns, k - columns);
            }
        }
    }
}

TEST_F(BlueNoisePoints, StayOneInEachBoxWhateverTheShift) {
    for (uint32_t k = 0; k <= 8; ++k) {
        for (uint32_t i = 0; i < 64; ++i) {
            std::vector<vec2> points;
            for (const BlueNoiseSample& s : raysOfAPixel(1U << k, uvec2(i, 7), 100 * i)) {
                points.push_back(s.point);
            }
            expectOneInEachBox(points, k / 2, k - k / 2);
        }
    }
}

// Over pixels, each single ray of any count is uniform: no frame is biased, whatever its number of rays.
TEST_F(BlueNoisePoints, AreUniformForEachRayOfAPixelByItself) {
    constexpr uint32_t width = 256;
    constexpr double count = width * width;
    constexpr double bins = 64.0;
    for (const auto& [number, perPixel] :
         {std::pair(0U, 1U), std::pair(2U, 3U), std::pair(1U, 4U), std::pair(6U, 7U), std::pair(255U, 256U)}) {
        std::vector<BlueNoiseCase> cases;
        for (uint32_t i = 0; i < width * width; ++i) {  // all texels, in 16 frames
            cases.push_back({uvec2(i % 64, i / 64 % 64), 9, i / 4096, number, perPixel});
        }
        std::vector<double> filled(64, 0.0);
        for (const BlueNoiseSample& s : sample(cases)) {
            ASSERT_LT(std::max(s.point.x, s.point.y), 1.0F);
            filled.at(static_cast<size_t>(s.point.x * 8.0F) + 8 * static_cast<size_t>(s.point.y * 8.0F)) += 1.0;
        }
        double chiSquare = 0.0;
        for (const double n : filled) {
            chiSquare += (n - count / bins) * (n - count / bins) / (count / bins);
        }
        EXPECT_LT(chiSquare, bins - 1.0 + 5.0 * std::sqrt(2.0 * (bins - 1.0))) << number << " of " << perPixel;
    }
}

TEST_F(BlueNoisePoints, TileTheScreenWithTheMaskMovedByTheStream) {
    std::vector<BlueNoiseCase> cases;
    for (const uint32_t stream : {0U, 1U}) {
        for (uint32_t i = 0; i < 64 * 64; ++i) {
            cases.push_back({uvec2(300 + i % 64, 500 + i / 64), stream, 0, 0, 1});
        }
    }
    const auto samples = sample(cases);
    std::set<uint32_t> texels;
    for (uint32_t i = 0; i < 64 * 64; ++i) {
        texels.insert(samples[i].texel);
        EXPECT_NE(samples[i].texel, samples[64 * 64 + i].texel);
        if (i % 64 != 0 && samples[i].texel % 64 != 0) {
            EXPECT_EQ(samples[i].texel, samples[i - 1].texel + 1) << "neighbours stay neighbours";
        }
    }
    EXPECT_EQ(texels.size(), 64U * 64U);
}

/// The largest difference between the share of the points in a box from the origin and its area, over a grid of boxes.
double discrepancy(const std::vector<vec2>& points) {
    double most = 0.0;
    constexpr int grid = 32;
    for (int i = 0; i < grid * grid; ++i) {
        const vec2 corner = vec2(i % grid + 1, i / grid + 1) / float(grid);
        const auto inside =
            std::ranges::count_if(points, [&](const vec2& p) { return p.x < corner.x && p.y < corner.y; });
        most = std::max(most, std::abs(double(inside) / double(points.size()) - double(corner.x) * double(corner.y)));
    }
    return most;
}

// The mean over some pixels. Random points have 0.123 at 64 frames and 0.068 at 256. Every second or fourth frame:
// those of a pixel that does not trace in each.
TEST_F(BlueNoisePoints, OfAnyRunOfFramesAreEvenlySpreadAtEachPixel) {
    constexpr uint32_t pixels = 8;
    for (const auto& [first, stride] :
         {std::pair(0U, 1U), std::pair(1000U, 1U), std::pair(5U, 2U), std::pair(3U, 4U)}) {
        double at64 = 0.0;
        double at256 = 0.0;
        for (uint32_t pixel = 0; pixel < pixels; ++pixel) {
            std::vector<BlueNoiseCase> cases;
            for (uint32_t i = 0; i < 256; ++i) {
                cases.push_back({uvec2(pixel, 3), 5, first + stride * i, 0, 1});
            }
            std::vector<vec2> points;
            for (const BlueNoiseSample& s : sample(cases)) {
                points.push_back(s.point);
            }
            at256 += discrepancy(points) / pixels;
            points.resize(64);
            at64 += discrepancy(points) / pixels;
        }
        EXPECT_LT(at64, 0.1) << first << ", " << stride;
        EXPECT_LT(at256, 0.04) << first << ", " << stride;
    }
}

TEST_F(BlueNoisePoints, NeverRepeat) {
    std::vector<BlueNoiseCase> cases;
    for (uint32_t i = 0; i < 4096; ++i) {
        cases.push_back({uvec2(3, 4), 5, i, 0, 1});
    }
    std::set<std::pair<float, float>> points;
    for (const BlueNoiseSample& s : sample(cases)) {
        points.emplace(s.point.x, s.point.y);
    }
    EXPECT_EQ(points.size(), cases.size());
}

}  // namespace
}  // namespace reflet::test::blue_noise_test
