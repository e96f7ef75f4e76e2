// Which volumes a point is in.
#include "scene/volumes_around.h"

#include "scene/builtin/assemble.h"

#include <gtest/gtest.h>

namespace reflet::test::volumes_around_test {
namespace {

Material volume(float thickness = 1.0F) {
    Material m;
    m.transmission.factor = 1.0F;
    m.transmission.thickness = thickness;
    return m;
}

void add(Scene& scene, const Material& material, Mesh mesh, const mat4& objectToWorld = mat4(1.0F)) {
    builtin::place(scene, "thing", builtin::addMaterial(scene, material), std::move(mesh), objectToWorld);
}

using Indices = std::vector<uint32_t>;

Indices around(const Scene& scene, const vec3& point) {
    return VolumeFinder{}.around(scene, nullptr, point);
}

TEST(VolumesAround, AWindingNumberIsOneInsideAndZeroOutside) {
    const Mesh ball = builtin::sphere(1.0F, 32);
    for (const vec3& direction : {vec3(1, 0, 0), vec3(0, 1, 0), glm::normalize(vec3(1, -2, 3))}) {
        EXPECT_NEAR(windingAround(ball.positions, ball.indices, 0.97F * direction).number, 1.0, 1e-5);
        EXPECT_NEAR(windingAround(ball.positions, ball.indices, 1.03F * direction).number, 0.0, 1e-5);
    }
    // A flat square, seen from a point in front of its middle: a sixth of the sphere at half its side.
    const Mesh square = builtin::patch({.right = {1, 0, 0}, .up = {0, 1, 0}});
    EXPECT_NEAR(windingAround(square.positions, square.indices, {0, 0, 1}).number, -1.0 / 6.0, 1e-6);
    EXPECT_NEAR(windingAround(square.positions, square.indices, {0, 0, -1}).number, 1.0 / 6.0, 1e-6);
}

TEST(VolumesAround, OnlyVolumesOfGlassCount) {
    Scene scene;
    add(scene, volume(0.0F), builtin::box({1, 1, 1}));  // a sheet
    Material opaque = volume();
    opaque.transmission.factor = 0.0F;
    add(scene, opaque, builtin::box({1, 1, 1}));
    EXPECT_EQ(around(scene, vec3(0.0F)), Indices{});
    add(scene, volume(), builtin::box({1, 1, 1}));
    EXPECT_EQ(around(scene, vec3(0.0F)), Indices{2});
    EXPECT_EQ(around(scene, {1.01F, 0, 0}), Indices{});
}

TEST(VolumesAround, TransformsMirrorsAndCornersOfTheBoundsAreRight) {
    Scene scene;
    const mat4 place = glm::translate(mat4(1.0F), vec3(5, 0, 0)) * glm::scale(mat4(1.0F), vec3(-2, 1, 3));
    add(scene, volume(), builtin::sphere(1.0F, 32), place);
    EXPECT_EQ(around(scene, {6.8F, 0, 0}), Indices{0});
    EXPECT_EQ(around(scene, {5, 0, 2.8F}), Indices{0});
    EXPECT_EQ(around(scene, {6.8F, 0.8F, 2.8F}), Indices{}) << "in the bounds, but outside";
}

TEST(VolumesAround, TheInnermostIsTheLast) {
    Scene scene;
    add(scene, volume(), builtin::sphere(1.0F, 16));
    add(scene, volume(), builtin::box({9, 9, 9}));
    add(scene, volume(), builtin::sphere(2.0F, 16));
    EXPECT_EQ(around(scene, vec3(0.1F)), (Indices{1, 2, 0}));
    EXPECT_EQ(around(scene, {1.5F, 0, 0}), (Indices{1, 2}));
}

TEST(VolumesAround, NoTriangleIsNearerThanTheClearance) {
    for (const Mesh& mesh : {builtin::sphere(1.0F, 64), builtin::box({1, 1, 1})}) {
        for (const float at : {0.0F, 0.5F, 0.9F, 1.5F}) {
            const double clearance = windingAround(mesh.positions, mesh.indices, {at, 0, 0}).clearance;
            EXPECT_LE(clearance, std::abs(1.0 - at) + 1e-6) << at;
            EXPECT_GE(clearance, 0.8 * std::abs(1.0 - at)) << at;
        }
    }
}

// A point that moves through a ball: the same answers as those of a new finder, but few searches.
TEST(VolumesAround, APointThatMovesIsSearchedOnlyNearSurfaces) {
    Scene scene;
    add(scene, volume(), builtin::sphere(1.0F, 64), glm::scale(mat4(1.0F), vec3(2.0F)));
    VolumeFinder finder;
    uint32_t inside = 0;
    for (int i = 0; i < 1000; ++i) {
        const vec3 point(-1.9F + 0.0041F * static_cast<float>(i), 0.1F, 0.2F);
        const Indices now = finder.around(scene, nullptr, point);
        ASSERT_EQ(now, around(scene, point)) << i;
        inside += now.empty() ? 0 : 1;
    }
    EXPECT_GT(inside, 900U);
    EXPECT_LT(inside, 1000U);
    EXPECT_LT(finder.searches(), 60U);
}

}  // namespace
}  // namespace reflet::test::volumes_around_test
