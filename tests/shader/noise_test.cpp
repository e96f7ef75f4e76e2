// noise.glsl. The numbers are deterministic, so statistical tests never become flaky. Bounds are five standard
// deviations of truly random numbers.
#include "shader/noise_test.h"

#include "shader/harness.h"

#include <algorithm>
#include <functional>

namespace reflet::test::noise_test {
namespace {

using uvec4 = glm::uvec4;
constexpr uint32_t side = 256;
constexpr double count = side * side;

uint32_t pcg(uint32_t v) {
    const uint32_t state = v * 747796405U + 2891336453U;
    const uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
}

class Noise : public ShaderTest {
protected:
    static std::vector<NoiseSample> image(uint32_t stream, uint32_t frameNumber, uvec2 corner = uvec2(0)) {
        std::vector<uvec4> keys;
        for (uint32_t y = 0; y < side; ++y) {
            for (uint32_t x = 0; x < side; ++x) {
                keys.emplace_back(corner.x + x, corner.y + y, stream, frameNumber);
            }
        }
        return mapOnDevice<NoiseSample>("noise_test.comp", keys);
    }

    using Pick = std::function<double(const NoiseSample&)>;
    static double first(const NoiseSample& s) { return s.pair.x; }
    static double second(const NoiseSample& s) { return s.pair.y; }

    static void expectUncorrelated(const std::vector<NoiseSample>& a, const Pick& ofA,
                                   const std::vector<NoiseSample>& b, const Pick& ofB, const char* what) {
        double sum = 0.0;
        for (size_t i = 0; i < a.size(); ++i) {
            sum += (ofA(a[i]) - 0.5) * (ofB(b[i]) - 0.5);
        }
        EXPECT_LT(std::abs(12.0 * sum / count), 5.0 / std::sqrt(count)) << what;
    }

    static void expectUniform(const std::vector<NoiseSample>& samples, const Pick& pick) {
        double sum = 0.0;
        double squares = 0.0;
        for (const NoiseSample& s : samples) {
            sum += pick(s);
            squares += (pick(s) - 0.5) * (pick(s) - 0.5);
        }
        EXPECT_NEAR(sum / count, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / count));
        EXPECT_NEAR(squares / count, 1.0 / 12.0, 5.0 * std::sqrt(1.0 / 180.0 / count));
        expectEvenBins(samples, 64, [&](const NoiseSample& s) { return static_cast<size_t>(pick(s) * 64.0); });
    }

    static void expectEvenBins(const std::vector<NoiseSample>& samples, size_t bins,
                               const std::function<size_t(const NoiseSample&)>& binOf) {
        std::vector<double> filled(bins, 0.0);
        for (const NoiseSample& s : samples) {
            filled.at(binOf(s)) += 1.0;
        }
        const double expected = count / static_cast<double>(bins);
        double chiSquare = 0.0;
        for (const double n : filled) {
            chiSquare += (n - expected) * (n - expected) / expected;
        }
        const auto freedom = static_cast<double>(bins - 1);
        EXPECT_LT(chiSquare, freedom + 5.0 * std::sqrt(2.0 * freedom));
        EXPECT_GT(chiSquare, freedom - 5.0 * std::sqrt(2.0 * freedom));  // more even than chance is a pattern, too
    }
};

TEST_F(Noise, staysBelowOneForEveryHash) {
    const std::vector<uint32_t> hashes = {0U,          255U,        256U,        0x7fffffffU,
                                          0x80000000U, 0xfffffeffU, 0xffffff00U, 0xffffffffU};
    const auto units = mapOnDevice<float>("hash_unit_test.comp", hashes);
    for (size_t i = 0; i < hashes.size(); ++i) {
        EXPECT_EQ(units[i], static_cast<float>(hashes[i] >> 8U) / 16777216.0F);
        EXPECT_LT(units[i], 1.0F);
    }
    EXPECT_EQ(units.front(), 0.0F);
}

TEST_F(Noise, isTheHashOfThePaper) {
    for (const auto& [stream, number] : {std::pair(0U, 0U), std::pair(7U, 123U), std::pair(0xdeadbeefU, 0xffffffffU)}) {
        const auto samples = image(stream, number, uvec2(16000, 5));
        for (uint32_t i = 0; i < samples.size(); ++i) {
            const uint32_t expected = pcg(16000 + i % side + pcg(5 + i / side + pcg(stream + pcg(number))));
            ASSERT_EQ(samples[i].hash, expected);
            ASSERT_EQ(samples[i].unit, samples[i].pair.x);
        }
    }
}

TEST_F(Noise, isTheSameEveryTime) {
    const auto a = image(3, 9);
    const auto b = image(3, 9);
    EXPECT_TRUE(std::ranges::equal(a, b, {}, &NoiseSample::pair, &NoiseSample::pair));
}

TEST_F(Noise, isUniformInBothNumbersAndInTheirSquare) {
    for (const uint32_t stream : {0U, 1U, pcg(0), pcg(1)}) {
        const auto samples = image(stream, 0);
        expectUniform(samples, first);
        expectUniform(samples, second);
        expectEvenBins(samples, 256, [](const NoiseSample& s) {
            return static_cast<size_t>(s.pair.x * 16.0F) + 16 * static_cast<size_t>(s.pair.y * 16.0F);
        });
    }
}

TEST_F(Noise, doesNotRepeatInNeighbouringPixels) {
    const auto here = image(0, 0);
    for (const uvec2 step :
         {uvec2(1, 0), uvec2(0, 1), uvec2(1, 1), uvec2(2, 0), uvec2(0, 2), uvec2(8, 0), uvec2(0, 8)}) {
        const auto there = image(0, 0, step);
        expectUncorrelated(here, first, there, first, "first numbers");
        expectUncorrelated(here, first, there, second, "first and second number");
        expectUncorrelated(here, second, there, second, "second numbers");
    }
}

TEST_F(Noise, doesNotRepeatInSuccessiveFramesAndStreams) {
    const auto here = image(0, 0);
    for (uint32_t step = 1; step <= 8; ++step) {
        for (const auto& there : {image(0, step), image(step, 0), image(step, step)}) {
            expectUncorrelated(here, first, there, first, "first numbers");
            expectUncorrelated(here, first, there, second, "first and second number");
        }
    }
}

TEST_F(Noise, givesTwoIndependentNumbers) {
    const auto samples = image(0, 0);
    expectUncorrelated(samples, first, samples, second, "the pair");
}

}  // namespace
}  // namespace reflet::test::noise_test
