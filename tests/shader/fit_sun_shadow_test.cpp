// fitSunShadow: every visible point and every caster is in the map, and the map is no larger than they need.
#include "renderer/draw_shadows/shadow_maps.h"
#include "shader/fit_cases.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace reflet::test::fit_sun_shadow_test {
namespace {

constexpr uint32_t resolution = 1024;
constexpr uvec2 pixels{640, 360};

Camera orthographic(Camera camera) {
    camera.orthographicHeight = 6.0F;
    return camera;
}

Camera withNear(Camera camera, float near) {
    camera.near = near;
    return camera;
}

const std::vector<Camera>& cameras() {
    static const std::vector<Camera> list = {
        cameraAt({12, 8, 9}, {0, 1, 0}),        // outside, all in view
        cameraAt({3, 2, 1}, {-1, 1, 0}),        // inside
        cameraAt({3, 2, 1}, {3, 9, 1}),         // inside, straight up
        cameraAt({60, 3, 0}, {0, 2, 0}),        // far off
        cameraAt({5.5F, 2, 0}, {5.5F, 2, 30}),  // beside it, along a face
        orthographic(cameraAt({12, 8, 9}, {0, 1, 0})),
        withNear(cameraAt({12, 8, 9}, {0, 1, 0}), 1e-3F),
        withNear(cameraAt({3, 2, 1}, {-1, 1, 0}), 1e-3F),
    };
    return list;
}

const std::vector<Aabb>& boxes() {
    static const std::vector<Aabb> list = {
        boxOf({-5, 0, -5}, {5, 4, 5}),
        boxOf({-5, 0, -5}, {5, 0, 5}),            // flat
        boxOf({-5, 1, -0.001F}, {5, 1.001F, 0}),  // a wire
        boxOf({-200, -1, -300}, {250, 80, 400}),
    };
    return list;
}

bool isFinite(const ShadowMapParams& map) {
    bool finite = std::isfinite(map.texelSize) && std::isfinite(map.depthRange);
    for (int column = 0; column < 4; ++column) {
        finite = finite && !glm::any(glm::isnan(map.worldToShadow[column])) &&
                 !glm::any(glm::isinf(map.worldToShadow[column]));
    }
    return finite;
}

template <class Check>
void forEveryFit(Check check) {
    for (size_t c = 0; c < cameras().size(); ++c) {
        const ViewParams view = makeViewParams(cameras()[c], pixels, 0, 0);
        for (size_t b = 0; b < boxes().size(); ++b) {
            for (const vec3& sun : sunDirections()) {
                SCOPED_TRACE(::testing::Message()
                             << "camera " << c << " box " << b << " sun " << sun.x << ' ' << sun.y << ' ' << sun.z);
                check(view, boxes()[b], sun, fitSunShadow(view.clipToWorld, boxes()[b], sun, resolution));
            }
        }
    }
}

TEST(FitSunShadow, holdsEveryVisiblePoint) {
    size_t visible = 0;
    forEveryFit([&](const ViewParams& view, const Aabb& box, const vec3&, const ShadowMapParams& map) {
        for (const vec3& p : pointsIn(box, 200)) {
            if (isVisible(view, p)) {
                const vec3 s = inMap(map, p);
                ASSERT_LE(std::max(std::abs(s.x), std::abs(s.y)), 1.0F) << p.x << ' ' << p.y << ' ' << p.z;
                ASSERT_GE(s.z, 0.0F) << p.x << ' ' << p.y << ' ' << p.z;
                ASSERT_LE(s.z, 1.0F) << p.x << ' ' << p.y << ' ' << p.z;
                ++visible;
            }
        }
    });
    EXPECT_GT(visible, 20000U);
}

TEST(FitSunShadow, holdsEveryCaster) {
    forEveryFit([&](const ViewParams&, const Aabb& box, const vec3&, const ShadowMapParams& map) {
        for (const vec3& p : pointsIn(box, 200)) {
            ASSERT_LE(inMap(map, p).z, 1.0F);  // whatever lies toward the sun is not cut off
        }
    });
}

TEST(FitSunShadow, statesItsOwnScale) {
    forEveryFit([&](const ViewParams&, const Aabb& box, const vec3& sun, const ShadowMapParams& map) {
        ASSERT_TRUE(isFinite(map));
        ASSERT_EQ(map.toSun, -sun);
        ASSERT_GT(map.texelSize, 0.0F);
        ASSERT_GT(map.depthRange, 0.0F);
        // Depth of 1 metre toward the sun; and the finer of both axes is a texel of texelSize or less.
        const glm::dmat3 m(map.worldToShadow);
        ASSERT_NEAR((m * glm::dvec3(-sun)).z * map.depthRange, 1.0, 1e-5);
        const glm::dmat3 rows = glm::transpose(m);
        const double texelX = 2.0 / glm::length(rows[0]) / resolution;
        const double texelY = 2.0 / glm::length(rows[1]) / resolution;
        ASSERT_NEAR(std::max(texelX, texelY), map.texelSize, 1e-5 * map.texelSize);
        ASSERT_NEAR(glm::dot(glm::normalize(rows[0]), glm::normalize(rows[1])), 0.0, 1e-5);
        ASSERT_NEAR(glm::dot(glm::normalize(rows[0]), glm::dvec3(sun)), 0.0, 1e-5);
        // Never coarser than the box's diagonal asks for, margins of two texels on each side included.
        ASSERT_LE(map.texelSize, 1.01F * glm::length(box.size()) / resolution);
    });
}

TEST(FitSunShadow, isFinerWhereTheViewSeesLess) {
    const Aabb box = boxes()[3];
    for (const vec3& sun : sunDirections()) {
        Camera narrow = cameraAt({12, 8, 9}, {14, 0, 10});
        narrow.fovY = glm::radians(20.0F);
        const auto clipToWorld = makeViewParams(narrow, pixels, 0, 0).clipToWorld;
        EXPECT_LT(fitSunShadow(clipToWorld, box, sun, resolution).texelSize,
                  0.05F * glm::length(box.size()) / resolution);
    }
}

TEST(FitSunShadow, isHalfAsFineWithHalfTheTexels) {
    const auto clipToWorld = makeViewParams(cameras()[0], pixels, 0, 0).clipToWorld;
    for (const vec3& sun : sunDirections()) {
        const float fine = fitSunShadow(clipToWorld, boxes()[0], sun, 2048).texelSize;
        const float coarse = fitSunShadow(clipToWorld, boxes()[0], sun, 1024).texelSize;
        EXPECT_NEAR(coarse / fine, 2.0F, 0.01F);
    }
}

TEST(FitSunShadow, fallsBackToTheWholeSceneWhenTheViewSeesNothingOfIt) {
    const auto clipToWorld = makeViewParams(cameraAt({12, 2, 0}, {30, 2, 0}), pixels, 0, 0).clipToWorld;
    for (const Aabb& box : {boxes()[0], boxes()[1], boxes()[2]}) {
        for (const vec3& sun : sunDirections()) {
            const ShadowMapParams map = fitSunShadow(clipToWorld, box, sun, resolution);
            ASSERT_TRUE(isFinite(map));
            for (const vec3& p : pointsIn(box, 100)) {
                const vec3 s = inMap(map, p);
                ASSERT_LE(std::max(std::abs(s.x), std::abs(s.y)), 1.0F);
                ASSERT_TRUE(s.z >= 0.0F && s.z <= 1.0F);
            }
        }
    }
}

TEST(FitSunShadow, acceptsABoxOfOnePoint) {
    const auto clipToWorld = makeViewParams(cameras()[0], pixels, 0, 0).clipToWorld;
    for (const vec3& sun : sunDirections()) {
        const ShadowMapParams map = fitSunShadow(clipToWorld, boxOf(vec3(1), vec3(1)), sun, resolution);
        ASSERT_TRUE(isFinite(map));
        const vec3 at = inMap(map, vec3(1));
        ASSERT_LE(std::max(std::abs(at.x), std::abs(at.y)), 1.0F);
    }
}

TEST(CentredSunShadow, HasTheOriginInItsMiddleAndItsSidesAtTheExtent) {
    const Aabb box = boxOf({-3, -1, 2}, {20, 4, 9});
    for (const vec3& sun : sunDirections()) {
        const ShadowMapParams map = centredSunShadow(box, sun, 10.0F, resolution);
        const vec4 origin = map.worldToShadow * vec4(0, 0, 0, 1);
        EXPECT_NEAR(origin.x, 0.0F, 1e-6F);
        EXPECT_NEAR(origin.y, 0.0F, 1e-6F);
        EXPECT_FLOAT_EQ(map.texelSize, 20.0F / resolution);
        EXPECT_NEAR(glm::length(vec3(glm::transpose(map.worldToShadow)[0])), 0.1F, 1e-6F);
        EXPECT_NEAR(glm::length(vec3(glm::transpose(map.worldToShadow)[1])), 0.1F, 1e-6F);
        for (unsigned i = 0; i < 8; ++i) {
            const float depth = (map.worldToShadow * vec4(box.corner(i), 1.0F)).z;
            EXPECT_GT(depth, 0.0F);
            EXPECT_LT(depth, 1.0F);
        }
    }
}

}  // namespace
}  // namespace reflet::test::fit_sun_shadow_test
