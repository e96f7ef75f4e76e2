// rays.glsl
#include "shader/rays_test.h"

#include "shader/directions.h"
#include "shader/harness.h"

namespace reflet::test {
namespace {

class RayPacking : public ShaderTest {};

TEST_F(RayPacking, keepsEverySlotExactly) {
    std::vector<RayTexel> texels;
    for (const int x : {0, 1, 255, 8191, 8192, 16382, 16383}) {
        for (const int y : {0, 1, 1023, 8192, 16383}) {
            for (int layer = 0; layer < 16; ++layer) {
                texels.push_back({x, y, layer, vec3(0, 0, 1), 1.0F, 1.0F});
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

TEST_F(RayPacking, keepsDirectionWeightAndTrust) {
    const auto directions = spreadDirections(5000);
    std::vector<RayTexel> texels;
    for (size_t i = 0; i < directions.size(); ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(directions.size() - 1);
        texels.push_back({0, 0, 0, directions[i], 2.0F * part, 1.0F - part});
    }
    const auto back = mapOnDevice<RayTexel>("rays_test.comp", texels);
    for (size_t i = 0; i < texels.size(); ++i) {
        ASSERT_LT(angleBetween(back[i].direction, texels[i].direction), glm::radians(0.005));
        ASSERT_NEAR(back[i].weight, texels[i].weight, 1e-3F * texels[i].weight + 1e-7F);  // 11 bits of a half float
        ASSERT_NEAR(back[i].trust, texels[i].trust, 1e-3F * texels[i].trust + 1e-7F);
    }
}

TEST_F(RayPacking, keepsTheWeightsThatMeanSomethingExactly) {
    const std::vector<RayTexel> texels = {{0, 0, 0, vec3(0, 1, 0), 1.0F, 0.0F}, {0, 0, 0, vec3(0, 1, 0), 0.0F, 1.0F}};
    const auto back = mapOnDevice<RayTexel>("rays_test.comp", texels);
    for (size_t i = 0; i < texels.size(); ++i) {
        EXPECT_EQ(back[i].weight, texels[i].weight);
        EXPECT_EQ(back[i].trust, texels[i].trust);
        EXPECT_EQ(back[i].direction, texels[i].direction);
    }
}

}  // namespace
}  // namespace reflet::test
