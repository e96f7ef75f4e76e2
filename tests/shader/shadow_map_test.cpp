// shadow_map.glsl: a plane never shadows itself, and an occluder's shadow ends where it should.
#include "shader/shadow_map_test.h"

#include "renderer/draw_shadows/shadow_maps.h"
#include "renderer/renderer.h"
#include "shader/directions.h"
#include "shader/harness.h"

#include <algorithm>
#include <random>

namespace reflet::test::shadow_map_test {
namespace {

constexpr uint32_t resolution = 512;

Camera cameraAbove() {
    Camera camera;
    camera.position = {6.0F, 5.0F, 7.0F};
    camera.target = {0.0F, 0.0F, 0.0F};
    return camera;
}

class ShadowMap : public ShaderTest {
protected:
    /// The map that the renderer fits to a box of 10 m, with a receiver through the box's centre.
    static ShadowScene sceneOf(const vec3& toSun, const vec3& receiverNormal) {
        Aabb box;
        box.add(vec3(-5.0F));
        box.add(vec3(5.0F));
        const ViewParams view = makeViewParams(cameraAbove(), uvec2(640, 360), 0, 0);
        ShadowScene scene{};
        scene.map = fitSunShadow(view.clipToWorld, box, -toSun, resolution);
        scene.shadowToWorld = mat4(glm::inverse(glm::dmat4(scene.map.worldToShadow)));
        scene.receiver = vec4(receiverNormal, 0.0F);
        scene.bias = ShadowSettings().bias;
        scene.resolution = resolution;
        return scene;
    }

    /// Points of the receiver all over the map, a little of it outside.
    static std::vector<ShadowCase> pointsOnReceiver(const ShadowScene& scene, int count) {
        std::mt19937 random(11);
        const auto number = [&] { return 2.04 * (random() >> 8U) / 16777216.0 - 1.02; };
        const glm::dmat4 toWorld = glm::inverse(glm::dmat4(scene.map.worldToShadow));
        const glm::dvec4 plane(scene.receiver);
        std::vector<ShadowCase> cases;
        for (int i = 0; i < count; ++i) {
            const glm::dvec2 xy(number(), number());
            const glm::dvec4 low = toWorld * glm::dvec4(xy, 0, 1);
            const glm::dvec4 high = toWorld * glm::dvec4(xy, 1, 1);
            const double depth = -glm::dot(plane, low) / glm::dot(plane, high - low);
            cases.push_back({vec3(glm::mix(low, high, depth)), vec3(scene.receiver)});
        }
        return cases;
    }

    /// Away from the map's edges, where a look-up may leave it.
    static bool isInside(const ShadowScene& scene, const ShadowCase& c) {
        const vec4 s = scene.map.worldToShadow * vec4(c.point, 1.0F);
        return std::max(std::abs(s.x), std::abs(s.y)) < 0.98F;
    }

    static std::vector<float> lookUp(const ShadowScene& scene, const std::vector<ShadowCase>& cases) {
        return mapOnDevice<float>("shadow_map_test.comp", cases, scene);
    }

    static vec3 toSunAt(float elevation, float turn) {
        return {std::cos(elevation) * std::cos(turn), std::sin(elevation), std::cos(elevation) * std::sin(turn)};
    }

    static void expectNoAcne(const vec3& toSun, const vec3& normal) {
        for (const uint32_t packed : {0U, 1U}) {
            ShadowScene scene = sceneOf(toSun, normal);
            scene.packedNormal = packed;
            const auto cases = pointsOnReceiver(scene, 2000);
            const auto visibility = lookUp(scene, cases);
            EXPECT_EQ(std::ranges::count(visibility, 0.0F), 0)
                << "sun " << toSun.x << ' ' << toSun.y << ' ' << toSun.z << " packed " << packed;
        }
    }
};

TEST_F(ShadowMap, aFloorDoesNotShadowItselfWhenTheSunIsFiveDegreesUpOrMore) {
    for (const float degrees : {5.0F, 5.5F, 7.0F, 10.0F, 20.0F, 45.0F, 70.0F, 89.0F, 90.0F}) {
        for (const float turn : {0.0F, 0.4F, 0.7854F, 2.0F, 4.0F}) {
            expectNoAcne(toSunAt(glm::radians(degrees), turn), vec3(0, 1, 0));
        }
    }
}

TEST_F(ShadowMap, aTiltedPlaneDoesNotShadowItself) {
    const vec3 toSun = toSunAt(glm::radians(50.0F), 1.0F);
    int tried = 0;
    for (const vec3& normal : spreadDirections(120)) {
        if (glm::dot(normal, toSun) > std::sin(glm::radians(5.0F))) {
            expectNoAcne(toSun, normal);
            ++tried;
        }
    }
    EXPECT_GT(tried, 40);
}

// Tolerance: the position of the point within its texel (0.71 texels from the centre) and the lateral offset of the
// look-up (0.75).
TEST_F(ShadowMap, aShadowsEdgeIsRightToATexelAndAHalf) {
    for (const float degrees : {90.0F, 60.0F, 25.0F}) {
        const vec3 toSun = toSunAt(glm::radians(degrees), 0.9F);
        ShadowScene scene = sceneOf(toSun, vec3(0, 1, 0));
        scene.occluder = vec4(0, 1, 0, -2.0F);  // the plane y = 2
        scene.occluderEdge = vec4(glm::normalize(vec3(0.8F, 0, 0.6F)), 0.3F);
        // How far past the edge the sun's ray through a point meets the occluder's plane [m].
        const auto past = [&](const glm::dvec3& p) {
            const glm::dvec3 met = p + glm::dvec3(toSun) * ((2.0 - p.y) / toSun.y);
            return glm::dot(glm::dvec4(scene.occluderEdge), glm::dvec4(met, 1.0));
        };
        // The same in metres of the map: the change for a metre aside, as the sun sees it.
        const glm::dvec3 a = glm::normalize(glm::cross(glm::dvec3(toSun), glm::dvec3(0.3, 0.1, -0.9)));
        const glm::dvec3 b = glm::cross(glm::dvec3(toSun), a);
        const double slope = std::hypot(past(a) - past(glm::dvec3(0.0)), past(b) - past(glm::dvec3(0.0)));
        const auto cases = pointsOnReceiver(scene, 20000);
        const auto visibility = lookUp(scene, cases);
        int dark = 0;
        int checked = 0;
        for (size_t i = 0; i < cases.size(); ++i) {
            const double texels = past(glm::dvec3(cases[i].point)) / slope / scene.map.texelSize;
            if (isInside(scene, cases[i]) && std::abs(texels) > 1.46) {
                ASSERT_EQ(visibility[i], texels < 0.0 ? 0.0F : 1.0F) << degrees << ": " << texels;
                dark += texels < 0.0 ? 1 : 0;
                ++checked;
            }
        }
        EXPECT_GT(dark, checked / 10);
        EXPECT_LT(dark, checked * 9 / 10);
        EXPECT_GT(checked, 17000);
    }
}

TEST_F(ShadowMap, anOccluderCountsAsSoonAsItIsHigherThanTheBias) {
    for (const float degrees : {90.0F, 60.0F, 30.0F, 10.0F}) {
        ShadowScene scene = sceneOf(toSunAt(glm::radians(degrees), 0.3F), vec3(0, 1, 0));
        const float lift = scene.bias * scene.map.texelSize;  // along the normal
        scene.occluderEdge = vec4(0, 0, 0, -1);               // everywhere
        auto cases = pointsOnReceiver(scene, 2000);
        // Nor below the map's lowest depth, which stands for nothing.
        std::erase_if(cases, [&](const ShadowCase& c) {
            return !isInside(scene, c) || (scene.map.worldToShadow * vec4(c.point, 1.0F)).z < 0.02F;
        });
        scene.occluder = vec4(0, 1, 0, -1.1F * lift);
        EXPECT_EQ(std::ranges::count(lookUp(scene, cases), 1.0F), 0) << degrees;
        scene.occluder = vec4(0, 1, 0, -0.9F * lift);
        EXPECT_EQ(std::ranges::count(lookUp(scene, cases), 0.0F), 0) << degrees;
    }
}

// At the bottom of a valley a texel's centre may lie on the other slope, above the receiver's plane.
TEST_F(ShadowMap, aValleyDoesNotShadowItselfAlongItsBottom) {
    for (const float degrees : {80.0F, 50.0F}) {
        ShadowScene scene = sceneOf(toSunAt(glm::radians(degrees), 0.9F), vec3(0, 1, 0));
        const vec3 across = glm::normalize(vec3(0.8F, 0, 0.6F));
        const float slope = 0.35F;
        scene.occluder = vec4(glm::normalize(vec3(0, 1, 0) - slope * across), 0.0F);  // y = slope · across
        scene.occluderEdge = vec4(-across, 0.0F);
        auto cases = pointsOnReceiver(scene, 20000);
        std::erase_if(cases, [&](const ShadowCase& c) {
            const float side = glm::dot(c.point, across);
            return !isInside(scene, c) || side > 0.0F || side < -1.5F * scene.map.texelSize;
        });
        EXPECT_GT(cases.size(), 20U);
        EXPECT_EQ(std::ranges::count(lookUp(scene, cases), 0.0F), 0) << degrees;
    }
}

TEST_F(ShadowMap, whatTheMapDoesNotHoldIsLit) {
    ShadowScene scene = sceneOf(toSunAt(1.0F, 0.0F), vec3(0, 1, 0));
    scene.occluder = vec4(0, 1, 0, -4.0F);
    scene.occluderEdge = vec4(0, 0, 0, -1);  // everywhere: all that the map holds is dark
    const auto at = [&](const vec2& xy) {
        return ShadowCase{vec3(scene.shadowToWorld * vec4(xy, 0.2F, 1.0F)), vec3(0, 1, 0)};
    };
    for (const vec2 out : {vec2(-1.02F, 0), vec2(1.02F, 0), vec2(0, 1.02F), vec2(0, -1.02F), vec2(30, 30)}) {
        EXPECT_EQ(lookUp(scene, std::vector{at(out)}).front(), 1.0F) << out.x << ' ' << out.y;
    }
    for (const vec2 in : {vec2(-0.98F, 0), vec2(0.98F, 0), vec2(0, 0.98F), vec2(0, -0.98F), vec2(0)}) {
        EXPECT_EQ(lookUp(scene, std::vector{at(in)}).front(), 0.0F) << in.x << ' ' << in.y;
    }
}

// A texel's corner is half a texel from its centre along both axes; over that distance, depth changes by `slope`.
TEST_F(ShadowMap, aConstantBiasEndsSelfShadowingOnceItIsWhatDepthChangesByFromATexelsCentreToItsCorner) {
    for (const float degrees : {70.0F, 45.0F, 20.0F}) {
        ShadowScene scene = sceneOf(toSunAt(glm::radians(degrees), 0.6F), vec3(0, 1, 0));
        scene.constant = 1;
        const auto cases = pointsOnReceiver(scene, 20000);
        // Metres of depth from one side of the map to the other, along both axes, by the plane's own points.
        const auto depthAt = [&](const vec2& xy) {
            const vec3 low(scene.shadowToWorld * vec4(xy, 0, 1));
            const vec3 high(scene.shadowToWorld * vec4(xy, 1, 1));
            return -low.y / (high.y - low.y) * scene.map.depthRange;
        };
        const float across =
            std::abs(depthAt({1, 0}) - depthAt({-1, 0})) + std::abs(depthAt({0, 1}) - depthAt({0, -1}));
        const float slope = 0.5F * across / resolution;
        const auto dark = [&](float bias) {
            scene.bias = bias;
            return std::ranges::count(lookUp(scene, cases), 0.0F);
        };
        EXPECT_GT(dark(0.0F), 8000) << degrees;  // half of them lie farther than their texel's centre
        EXPECT_GT(dark(0.9F * slope), 0) << degrees;
        EXPECT_EQ(dark(1.05F * slope), 0) << degrees;
    }
}

TEST_F(ShadowMap, withAConstantBiasAnOccluderCountsAsSoonAsItIsNearerToTheSunByMore) {
    ShadowScene scene = sceneOf(vec3(0, 1, 0), vec3(0, 1, 0));
    scene.constant = 1;
    scene.bias = 0.05F;
    scene.occluderEdge = vec4(0, 0, 0, -1);  // everywhere
    auto cases = pointsOnReceiver(scene, 2000);
    std::erase_if(cases, [&](const ShadowCase& c) { return !isInside(scene, c); });
    scene.occluder = vec4(0, 1, 0, -0.052F);
    EXPECT_EQ(std::ranges::count(lookUp(scene, cases), 1.0F), 0);
    scene.occluder = vec4(0, 1, 0, -0.048F);
    EXPECT_EQ(std::ranges::count(lookUp(scene, cases), 0.0F), 0);
}

TEST_F(ShadowMap, whatFacesAwayFromTheSunIsDark) {
    const vec3 toSun = toSunAt(1.0F, 0.0F);
    const ShadowScene scene = sceneOf(toSun, vec3(0, 1, 0));
    std::vector<ShadowCase> cases;
    for (const vec3& normal : spreadDirections(500)) {
        if (glm::dot(normal, toSun) < -1e-6F) {
            cases.push_back({vec3(0, 0.5F, 0), normal});
            cases.push_back({vec3(500.0F), normal});
        }
    }
    for (const float visibility : lookUp(scene, cases)) {
        EXPECT_EQ(visibility, 0.0F);
    }
}

}  // namespace
}  // namespace reflet::test::shadow_map_test
