// lamp.glsl, with lamps as the renderer passes them: KHR_lights_punctual.
#include "shader/lamp_test.h"

#include "renderer/gpu_scene.h"
#include "shader/directions.h"
#include "shader/harness.h"

#include <algorithm>

namespace reflet::test::lamp_test {
namespace {

class Lamps : public ShaderTest {
protected:
    static LampParams params(const Lamp& lamp) {
        Scene scene;
        scene.lamps.push_back(lamp);
        const GpuScene onDevice(device(), scene, [](const std::string& text) { ADD_FAILURE() << text; });
        EXPECT_EQ(onDevice.lamps(false).count, 1U);
        return onDevice.lamps(false).lamps[0];
    }

    static std::vector<LampLight> lightAt(const Lamp& lamp, const std::vector<vec3>& points) {
        const LampParams p = params(lamp);
        std::vector<LampCase> cases;
        cases.reserve(points.size());
        for (const vec3& point : points) {
            cases.push_back({p, point});
        }
        return mapOnDevice<LampLight>("lamp_test.comp", cases);
    }

    static Lamp pointLamp() {
        Lamp lamp;
        lamp.position = {2.0F, 3.0F, -1.0F};
        lamp.intensity = {8.0F, 4.0F, 2.0F};
        return lamp;
    }

    static Lamp spotLamp() {
        Lamp lamp = pointLamp();
        lamp.type = Lamp::Type::spot;
        lamp.direction = glm::normalize(vec3(1.0F, -2.0F, 0.5F));
        lamp.innerAngle = glm::radians(15.0F);
        lamp.outerAngle = glm::radians(35.0F);
        return lamp;
    }

    /// A point in front of a lamp, this far off its axis.
    static vec3 offAxis(const Lamp& lamp, float angle, float distance) {
        const vec3 side = glm::normalize(glm::cross(lamp.direction, vec3(0, 0, 1)));
        return lamp.position + distance * (std::cos(angle) * lamp.direction + std::sin(angle) * side);
    }
};

TEST_F(Lamps, pointLightFallsWithTheSquareOfTheDistance) {
    const Lamp lamp = pointLamp();
    std::vector<vec3> points = spreadDirections(300);
    for (size_t i = 0; i < points.size(); ++i) {
        points[i] = lamp.position + points[i] * std::exp2(static_cast<float>(i % 12) - 3.0F);
    }
    const auto light = lightAt(lamp, points);
    for (size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(lamp.position) - glm::dvec3(points[i]);
        for (int channel = 0; channel < 3; ++channel) {
            const double expected = lamp.intensity[channel] / glm::dot(d, d);
            ASSERT_NEAR(light[i].irradiance[channel], expected, 2e-6 * expected);
        }
        ASSERT_LT(angleBetween(light[i].toLamp, vec3(d)), 5e-7);
        ASSERT_NEAR(glm::length(light[i].toLamp), 1.0F, 5e-7F);
    }
}

TEST_F(Lamps, stayFiniteAtTheLampItself) {
    const Lamp lamp = pointLamp();
    const LampLight light = lightAt(lamp, {lamp.position}).front();
    EXPECT_TRUE(std::isfinite(light.irradiance.x));
    EXPECT_FALSE(glm::any(glm::isnan(light.toLamp)));
}

TEST_F(Lamps, endAtTheirRangeSmoothly) {
    Lamp lamp = pointLamp();
    lamp.range = 5.0F;
    const std::vector<float> distances = {0.05F, 1.0F, 2.5F, 4.0F, 4.999F, 5.001F, 6.0F, 500.0F};
    std::vector<vec3> points;
    points.reserve(distances.size());
    for (const float d : distances) {
        points.push_back(lamp.position + vec3(0, d, 0));
    }
    const auto light = lightAt(lamp, points);
    for (size_t i = 0; i < distances.size(); ++i) {
        const double d = distances[i];
        const double window = std::max(0.0, 1.0 - std::pow(d / 5.0, 4.0));  // as KHR_lights_punctual recommends
        EXPECT_NEAR(light[i].irradiance.x, 8.0 / (d * d) * window, 1e-5 * 8.0 / (d * d)) << d;
    }
    EXPECT_EQ(light[5].irradiance, vec3(0.0F));
    EXPECT_EQ(light[7].irradiance, vec3(0.0F));
}

TEST_F(Lamps, spotIsFullInsideItsInnerConeAndDarkOutsideItsOuter) {
    const Lamp lamp = spotLamp();
    std::vector<vec3> points;
    for (const float degrees : {0.0F, 8.0F, 14.9F, 35.1F, 60.0F, 90.0F, 180.0F}) {
        points.push_back(offAxis(lamp, glm::radians(degrees), 2.0F));
    }
    const auto light = lightAt(lamp, points);
    for (size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(light[i].irradiance.x, i < 3 ? 2.0F : 0.0F, 1e-5F) << i;
    }
}

TEST_F(Lamps, spotFallsWithTheSquareOfTheCosineBetweenItsCones) {
    const Lamp lamp = spotLamp();
    const double inner = std::cos(lamp.innerAngle);
    const double outer = std::cos(lamp.outerAngle);
    for (const double part : {0.1, 0.25, 0.5, 0.75, 0.9}) {  // of the way between the cosines
        const double angle = std::acos(outer + part * (inner - outer));
        const LampLight light = lightAt(lamp, {offAxis(lamp, static_cast<float>(angle), 2.0F)}).front();
        // A rounding of the cosine, 6e-8, over the 0.147 between the cones.
        EXPECT_NEAR(light.irradiance.x, 2.0 * part * part, 1e-5) << part;
    }
}

TEST_F(Lamps, spotWithConesOfOneSizeHasAHardEdge) {
    Lamp lamp = spotLamp();
    lamp.innerAngle = lamp.outerAngle;
    const auto light =
        lightAt(lamp, {offAxis(lamp, glm::radians(34.9F), 1.0F), offAxis(lamp, glm::radians(35.1F), 1.0F)});
    EXPECT_NEAR(light[0].irradiance.x, 8.0F, 1e-4F);
    EXPECT_EQ(light[1].irradiance.x, 0.0F);
}

TEST_F(Lamps, directionalLightIsTheSameEverywhere) {
    Lamp lamp = spotLamp();
    lamp.type = Lamp::Type::directional;
    for (const LampLight& light : lightAt(lamp, {vec3(0), vec3(100, -3, 7), lamp.position})) {
        EXPECT_EQ(light.irradiance, lamp.intensity);
        EXPECT_EQ(light.toLamp, -lamp.direction);
    }
}

}  // namespace
}  // namespace reflet::test::lamp_test
