// directional_light.glsl against light whose irradiance is known for every normal.
#include "shader/directional_light_test.h"

#include "shader/harness.h"

#include <cmath>

namespace reflet::test::directional_light_test {
namespace {

constexpr uint32_t side = 64;
constexpr float upperHalf = 0.0F;
const float spot = std::cos(glm::radians(5.0F));

vec3 tilted(float degrees) {
    const float angle = glm::radians(degrees);
    return {std::sin(angle), std::cos(angle), 0.0F};
}

class DirectionalLight : public ShaderTest {
protected:
    static std::vector<TurnedLight> turn(const std::vector<LitSurface>& surfaces) {
        return mapOnDevice<TurnedLight>("directional_light_test.comp", surfaces, side);
    }
};

TEST_F(DirectionalLight, IsTheSameForTheSameNormal) {
    std::vector<LitSurface> surfaces;
    for (const float degrees : {-60.0F, 0.0F, 10.0F, 80.0F}) {
        surfaces.push_back({tilted(20.0F), tilted(20.0F), tilted(degrees), spot});
        surfaces.push_back({tilted(degrees), tilted(degrees), tilted(0.0F), upperHalf});
    }
    surfaces.push_back({tilted(0.0F), tilted(40.0F), tilted(180.0F), spot});  // dark: behind the surface
    for (const TurnedLight& light : turn(surfaces)) {
        EXPECT_EQ(light.factor, 1.0F);
    }
}

TEST_F(DirectionalLight, OfTheUpperHalfFallsOnTiltedSurfacesAsComputed) {
    std::vector<LitSurface> surfaces;
    for (float degrees = -80.0F; degrees <= 80.0F; degrees += 20.0F) {
        surfaces.push_back({tilted(0.0F), tilted(degrees), tilted(0.0F), upperHalf});
    }
    const std::vector<TurnedLight> found = turn(surfaces);
    for (size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].mean, 1.0F, 1e-4F);
        // Half of the sky, plus the part of the other half above the surface.
        EXPECT_NEAR(found[i].factor, 0.5F * (1.0F + surfaces[i].turnedTo.y), 0.01F) << i;
    }
}

TEST_F(DirectionalLight, OfASmallLightGoesMostOfTheWay) {
    std::vector<LitSurface> surfaces;
    for (const float from : {-50.0F, -20.0F, 35.0F, 60.0F}) {
        for (const float by : {-25.0F, -10.0F, 10.0F, 25.0F}) {
            surfaces.push_back({tilted(0.0F), tilted(by), tilted(from), spot});
        }
    }
    const std::vector<TurnedLight> found = turn(surfaces);
    for (size_t i = 0; i < found.size(); ++i) {
        const LitSurface& s = surfaces[i];
        const float change = glm::dot(s.middle, s.turnedTo) / glm::dot(s.middle, s.normal) - 1.0F;
        const float share = (found[i].factor - 1.0F) / change;
        EXPECT_GT(share, 0.45F) << i << ": " << found[i].factor << " for " << 1.0F + change;
        EXPECT_LT(share, 1.05F) << i << ": " << found[i].factor << " for " << 1.0F + change;
    }
}

}  // namespace
}  // namespace reflet::test::directional_light_test
