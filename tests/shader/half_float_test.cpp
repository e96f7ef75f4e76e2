// half_float.glsl
#include "shader/harness.h"

#include <cmath>
#include <limits>
#include <random>

namespace reflet::test::half_float_test {
namespace {

class HalfFloat : public ShaderTest {};

TEST_F(HalfFloat, keepsWhatFitsAndClampsWhatDoesNot) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::vector<vec3> given = {{nan, -nan, 0.0F},      {infinity, -infinity, 1.0F},
                                     {-1.0F, -1e30F, 1e30F}, {65504.0F, 65505.0F, 65503.0F},
                                     {0.5F, 1e-30F, -0.0F},  {1.0F, nan, infinity}};
    const std::vector<vec3> kept = {{0.0F, 0.0F, 0.0F},     {65504.0F, 0.0F, 1.0F},
                                    {0.0F, 0.0F, 65504.0F}, {65504.0F, 65504.0F, 65503.0F},
                                    {0.5F, 1e-30F, 0.0F},   {1.0F, 0.0F, 65504.0F}};
    const auto result = mapOnDevice<vec3>("half_float_test.comp", given);
    for (size_t i = 0; i < given.size(); ++i) {
        EXPECT_EQ(result[i], kept[i]) << i << ": " << result[i].x << ' ' << result[i].y << ' ' << result[i].z;
    }
}

TEST_F(HalfFloat, roundingGivesTheNearestOneAndNoBias) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-13.0F, 15.9F);
    std::vector<vec3> given = {{65504.0F, 65503.0F, 1.0F}, {0.0F, 0.5F, 1.0F + 1.0F / 4096.0F}};
    for (int i = 0; i < 10000; ++i) {
        given.emplace_back(std::exp2(exponent(random)), std::exp2(exponent(random)), std::exp2(exponent(random)));
    }
    const auto result = mapOnDevice<vec3>("half_float_test.comp", given, NoParams{},
                                          [](gpu::ComputePass& pass) { pass.constant("rounds", 1U); });
    EXPECT_EQ(result[0], vec3(65504.0F, 65504.0F, 1.0F));
    double bias = 0.0;
    for (size_t i = 0; i < given.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float v = given[i][c];
            const float ulp = v > 0.0F ? std::exp2(std::floor(std::log2(v)) - 10.0F) : 1.0F;
            ASSERT_EQ(std::fmod(result[i][c], ulp), 0.0F) << v;
            ASSERT_LE(std::abs(result[i][c] - v), 0.5F * ulp) << v;
            bias += (result[i][c] - v) / ulp;
        }
    }
    EXPECT_LT(std::abs(bias) / (3.0 * static_cast<double>(given.size())), 0.01);
}

}  // namespace
}  // namespace reflet::test::half_float_test
