// rays.glsl
#include "shader/rays_test.h"

#include "shader/directions.h"
#include "shader/harness.h"

#include <algorithm>

namespace reflet::test::rays_test {
namespace {

class RayPacking : public ShaderTest {};

TEST_F(RayPacking, keepsEverySlotExactly) {
    std::vector<RayTexel> texels;
    for (const int x : {0, 1, 255, 8191, 8192, 16382, 16383}) {
        for (const int y : {0, 1, 1023, 8192, 16383}) {
            for (int layer = 0; layer < 16; ++layer) {
                texels.push_back({x, y, layer, vec3(0, 0, 1), 1.0F, 1.0F, 0.0F});
            }
        }
    }
    const auto back = mapOnDevice<RayTexel>("rays_test.comp", texels);
    for (size_t i = 0; i < texels.size(); ++i) {
        ASSERT_EQ(back[i].slotX, texels[i].slotX);
        ASSERT_EQ(back[i].slotY, texels[i].slotY);
        ASSERT_EQ(back[i].slotZ, texels[i].slotZ);
    }
}

TEST_F(RayPacking, keepsDirectionWeightTrustSpreadAndHighlights) {
    const auto directions = spreadDirections(5000);
    std::vector<RayTexel> texels;
    for (size_t i = 0; i < directions.size(); ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(directions.size() - 1);
        texels.push_back({0, 0, 0, directions[i], 2.0F * part, 1.0F - part, part * part, static_cast<uint32_t>(i % 2)});
    }
    const auto back = mapOnDevice<RayTexel>("rays_test.comp", texels);
    for (size_t i = 0; i < texels.size(); ++i) {
        ASSERT_LT(angleBetween(back[i].direction, texels[i].direction), glm::radians(0.005));
        ASSERT_NEAR(back[i].weight, texels[i].weight, 1e-3F * texels[i].weight + 1e-7F);  // 11 bits of a half float
        ASSERT_NEAR(back[i].trust, texels[i].trust, 0.5 / 255.0 + 1e-6);
        ASSERT_NEAR(back[i].spread, texels[i].spread, 0.5 / 255.0 + 1e-6);
        ASSERT_EQ(back[i].highlighted, texels[i].highlighted);
    }
}

TEST_F(RayPacking, keepsTheWeightsThatMeanSomethingExactly) {
    const std::vector<RayTexel> texels = {{0, 0, 0, vec3(0, 1, 0), 1.0F, 0.0F, 1.0F, 0},
                                          {0, 0, 0, vec3(0, 1, 0), 0.0F, 1.0F, 0.0F, 1}};
    const auto back = mapOnDevice<RayTexel>("rays_test.comp", texels);
    for (size_t i = 0; i < texels.size(); ++i) {
        EXPECT_EQ(back[i].weight, texels[i].weight);
        EXPECT_EQ(back[i].trust, texels[i].trust);
        EXPECT_EQ(back[i].spread, texels[i].spread);
        EXPECT_EQ(back[i].direction, texels[i].direction);
    }
}

class WaitingRays : public RayPacking {
protected:
    static std::vector<WaitingItem> packed(const std::vector<WaitingItem>& rays) {
        return mapOnDevice<WaitingItem>("waiting_ray_test.comp", rays);
    }
};

TEST_F(WaitingRays, keepAllAndNothingOfTheirWeightExactly) {
    const auto back = packed({{1.0F, 0.0F, 0}, {0.0F, 0.0F, 1}});
    EXPECT_EQ(back[0].rest, 1.0F);
    EXPECT_EQ(back[1].rest, 0.0F);
}

TEST_F(WaitingRays, keepWhatIsLeftOfTheirWeightToHalfAStepOfSixteenBits) {
    std::vector<WaitingItem> rays;
    for (int i = 0; i <= 200000; ++i) {
        rays.push_back({static_cast<float>(i) / 200000.0F, 0.0F, 0});
    }
    const auto back = packed(rays);
    for (size_t i = 0; i < rays.size(); ++i) {
        ASSERT_NEAR(back[i].rest, rays[i].rest, 0.5 / 65535.0 + 1e-7);  // and a rounding of floats near 1
    }
}

TEST_F(WaitingRays, knowWhetherTheyWereOccludedOnTheScreen) {
    std::vector<WaitingItem> rays;
    for (const float clear : {0.0F, 1e-8F, 1e-3F, 1.0F, 65504.0F, 1e5F}) {
        for (const uint32_t lost : {0U, 1U}) {
            rays.push_back({0.4F, clear, lost});
        }
    }
    const auto back = packed(rays);
    for (size_t i = 0; i < rays.size(); i += 2) {
        EXPECT_EQ(back[i].lost, 0U);
        EXPECT_EQ(back[i + 1].lost, 1U);
        EXPECT_EQ(back[i].clear, back[i + 1].clear);
        EXPECT_EQ(back[i].rest, back[i + 1].rest);
    }
}

TEST_F(WaitingRays, neverContinueFromBeyondTheirClearDistance) {
    constexpr double largest = 65504.0;
    constexpr double smallestNormal = 1.0 / 16384.0;  // below it all steps of half floats are 6e-8
    std::vector<WaitingItem> rays{{1.0F, 0.0F, 0}, {1.0F, 1e5F, 0}};
    for (int i = 0; i < 250000; ++i) {  // 1e-6 m to 72 km
        rays.push_back({1.0F, static_cast<float>(1e-6 * std::pow(1.0001, i)), 0});
    }
    for (int power = -14; power <= 16; ++power) {
        rays.push_back({1.0F, std::ldexp(1.0F, power), 0});
    }
    const auto back = packed(rays);
    for (size_t i = 0; i < rays.size(); ++i) {
        const double clear = std::min<double>(rays[i].clear, largest);
        ASSERT_LE(back[i].clear, clear < smallestNormal ? clear + 3e-8 : clear) << clear;
        ASSERT_GE(back[i].clear, clear * (1.0 - 0.002) - 6e-8) << clear;
    }
}

}  // namespace
}  // namespace reflet::test::rays_test
