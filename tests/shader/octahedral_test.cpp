// octahedral.glsl
#include "shader/directions.h"
#include "shader/harness.h"

#include <algorithm>

namespace reflet::test::octahedral_test {
namespace {

class Octahedral : public ShaderTest {
protected:
    static void expectRoundTrip(const std::vector<vec3>& directions) {
        // 16 bits an axis: cells of 3.05e-5, stretched by the map to at most 0.004 degrees from centre to corner.
        const double tolerance = glm::radians(0.005);
        const auto back = mapOnDevice<vec3>("octahedral_test.comp", directions);
        double worst = 0.0;
        for (size_t i = 0; i < directions.size(); ++i) {
            const double angle = angleBetween(directions[i], back[i]);
            ASSERT_LT(angle, tolerance) << directions[i].x << ' ' << directions[i].y << ' ' << directions[i].z;
            ASSERT_NEAR(glm::length(glm::dvec3(back[i])), 1.0, 3e-7);
            worst = std::max(worst, angle);
        }
        RecordProperty("worstDegrees", std::to_string(glm::degrees(worst)));
    }
};

TEST_F(Octahedral, keepsEveryDirectionToFiveThousandthsOfADegree) {
    expectRoundTrip(spreadDirections(200000));
}

TEST_F(Octahedral, keepsAxesAndSeamsToFiveThousandthsOfADegree) {
    expectRoundTrip(axesAndSeams());
}

TEST_F(Octahedral, givesAxesBackExactly) {
    const std::vector<vec3> axes = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    EXPECT_EQ(mapOnDevice<vec3>("octahedral_test.comp", axes), axes);
}

}  // namespace
}  // namespace reflet::test::octahedral_test
