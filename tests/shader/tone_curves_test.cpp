// tone_curves.glsl
#include "shader/directions.h"
#include "shader/harness.h"

#include <algorithm>
#include <string>

namespace reflet::test::tone_curves_test {
namespace {

constexpr uint32_t srgb = 0;
constexpr uint32_t aces = 1;
constexpr uint32_t agx = 2;
constexpr uint32_t neutral = 3;
constexpr uint32_t toneCurves[] = {aces, agx, neutral};

class ToneCurves : public ShaderTest {
protected:
    static std::vector<vec3> apply(uint32_t curve, const std::vector<vec3>& colors) {
        return mapOnDevice<vec3>("tone_curves_test.comp", colors, {},
                                 [&](gpu::ComputePass& pass) { pass.constant("curve", curve); });
    }

    /// Greys from 1e-6 to 65504, evenly by their logarithm, black first.
    static std::vector<vec3> greys() {
        std::vector<vec3> colors = {vec3(0.0F)};
        for (int i = 0; i <= 4000; ++i) {
            colors.emplace_back(static_cast<float>(1e-6 * std::pow(65504e6, i / 4000.0)));
        }
        return colors;
    }

    /// Colours of every hue and saturation, the purest included, from dark to the largest half float.
    static std::vector<vec3> colors() {
        std::vector<vec3> result;
        for (const vec3& d : spreadDirections(500)) {
            for (int exponent = -20; exponent <= 16; ++exponent) {
                result.push_back(glm::min(glm::abs(d) * std::exp2(static_cast<float>(exponent)), 65504.0F));
            }
        }
        for (int bits = 1; bits < 8; ++bits) {
            const vec3 pure(bits & 1, (bits >> 1) & 1, bits >> 2);
            for (const float strength : {1e-4F, 0.18F, 1.0F, 100.0F, 1e4F, 65504.0F}) {
                result.push_back(pure * strength);
            }
        }
        return result;
    }
};

TEST_F(ToneCurves, stayBetweenBlackAndWhiteForAllRadiance) {
    for (const uint32_t curve : toneCurves) {
        for (const auto& given : {greys(), colors()}) {
            const auto shown = apply(curve, given);
            for (size_t i = 0; i < given.size(); ++i) {
                for (int channel = 0; channel < 3; ++channel) {
                    // NaN fails both. One rounding above white is still white after the encoding, which clamps.
                    ASSERT_GE(shown[i][channel], 0.0F)
                        << curve << ": " << given[i].x << ' ' << given[i].y << ' ' << given[i].z;
                    ASSERT_LE(shown[i][channel], 1.0F + 1e-6F)
                        << curve << ": " << given[i].x << ' ' << given[i].y << ' ' << given[i].z;
                }
            }
        }
    }
}

TEST_F(ToneCurves, keepBlackBlack) {
    for (const uint32_t curve : toneCurves) {
        // AgX's sigmoid does not end at 0 to the last bit: a quarter of a step of 8 bits, encoded, is 1e-4.
        const vec3 shown = apply(curve, {vec3(0.0F)}).front();
        EXPECT_NEAR(std::max({shown.x, shown.y, shown.z}), 0.0F, curve == agx ? 1e-4F : 0.0F) << curve;
    }
}

TEST_F(ToneCurves, neverShowMoreLightDarker) {
    for (const uint32_t curve : toneCurves) {
        const auto shown = apply(curve, greys());
        for (size_t i = 1; i < shown.size(); ++i) {
            ASSERT_GE(shown[i].y, shown[i - 1].y - 1e-6F) << curve;  // a rounding of values near 1
        }
        EXPECT_GT(shown.back().y, 0.95F) << curve;
    }
}

TEST_F(ToneCurves, keepGreyGrey) {
    for (const uint32_t curve : toneCurves) {
        for (const vec3& c : apply(curve, greys())) {
            // AgX's published inset matrix tints grey by up to 1.4e-4 of its value: a tenth of an 8-bit step remains.
            ASSERT_NEAR(c.x, c.y, 6e-4F) << curve;
            ASSERT_NEAR(c.z, c.y, 6e-4F) << curve;
        }
    }
}

TEST_F(ToneCurves, neutralTakesOffTheDielectricReflectionAndNothingElseBelowItsStart) {
    std::vector<vec3> given;
    for (int i = 0; i <= 1000; ++i) {
        given.emplace_back(0.08F + 0.7199F * static_cast<float>(i) / 1000.0F);  // up to just below 0.8
    }
    given.emplace_back(0.3F, 0.1F, 0.7F);
    given.emplace_back(0.79F, 0.08F, 0.4F);
    const auto shown = apply(neutral, given);
    for (size_t i = 0; i < given.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            ASSERT_NEAR(shown[i][channel], given[i][channel] - 0.04F, 1e-6F);
        }
    }
}

TEST_F(ToneCurves, neutralIsASquareBelowTwiceTheDielectricReflection) {
    // Khronos: offset x - 6.25 x², so that what is left is 6.25 x².
    for (const float x : {0.01F, 0.02F, 0.04F, 0.0799F}) {
        EXPECT_NEAR(apply(neutral, {vec3(x)}).front().x, 6.25F * x * x, 1e-7F);
    }
}

// The specification's own steps in double precision.
TEST_F(ToneCurves, neutralCompressesHighlightsAsSpecified) {
    for (const glm::dvec3 c :
         {glm::dvec3(2, 1, 0.5), glm::dvec3(10, 0.1, 0), glm::dvec3(1, 1, 1), glm::dvec3(50, 400, 3)}) {
        const double lowest = std::min({c.x, c.y, c.z});
        glm::dvec3 color = c - (lowest < 0.08 ? lowest - 6.25 * lowest * lowest : 0.04);
        const double peak = std::max({color.x, color.y, color.z});
        const double d = 1.0 - 0.76;
        const double newPeak = 1.0 - d * d / (peak + d - 0.76);
        color *= newPeak / peak;
        const double g = 1.0 - 1.0 / (0.15 * (peak - newPeak) + 1.0);
        const glm::dvec3 expected = glm::mix(color, glm::dvec3(newPeak), g);
        const vec3 shown = apply(neutral, {vec3(c)}).front();
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(shown[channel], expected[channel], 2e-6);
        }
    }
}

TEST_F(ToneCurves, acesFollowsItsRationalFitForGrey) {
    for (const double x : {0.01, 0.18, 1.0, 8.0, 1000.0}) {
        const double expected = (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081);
        // The rows of both matrices sum to 1 only to about 3e-5.
        EXPECT_NEAR(apply(aces, {vec3(static_cast<float>(x))}).front().y, std::min(expected, 1.0), 1e-4) << x;
    }
}

TEST_F(ToneCurves, agxKeepsMiddleGrey) {
    const vec3 shown = apply(agx, {vec3(0.18F)}).front();
    RecordProperty("shown", std::to_string(shown.y));
    EXPECT_NEAR(shown.y, 0.18F, 0.03F);
}

TEST_F(ToneCurves, encodesSrgbByTheStandard) {
    std::vector<vec3> given;
    for (int i = 0; i <= 3000; ++i) {
        given.emplace_back(static_cast<float>(i) / 3000.0F);
    }
    for (const float x : {0.0031308F, 0.0031307F, 0.0031309F, 1e-6F}) {
        given.emplace_back(x);
    }
    const auto encoded = apply(srgb, given);
    for (size_t i = 0; i < given.size(); ++i) {
        const double c = given[i].x;
        const double expected = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
        ASSERT_NEAR(encoded[i].x, expected, 1e-5) << c;  // the device's pow; a step of 8 bits is 4e-3
    }
}

TEST_F(ToneCurves, encodeWhatIsOutsideAsItsNearestEnd) {
    const auto encoded = apply(srgb, {vec3(-1.0F), vec3(0.0F), vec3(1.0F), vec3(65504.0F)});
    EXPECT_EQ(encoded[0], vec3(0.0F));
    EXPECT_EQ(encoded[1], vec3(0.0F));
    EXPECT_NEAR(encoded[2].x, 1.0F, 1e-6F);
    EXPECT_EQ(encoded[3], encoded[2]);
}

}  // namespace
}  // namespace reflet::test::tone_curves_test
