// Automatic placement of probes.
#include "renderer/probe/place_probes.h"

#include "pass/harness.h"
#include "scene/builtin.h"

#include <algorithm>

namespace reflet::test::place_probes_test {
namespace {

const vec3 outside(0.0F, 0.0F, 100.0F);
const vec3 inside(1.5F, 1.0F, 1.5F);  // of the rooms, not of things in them

std::vector<Probe> placed(const Scene& scene, uint32_t count, const vec3& eye = inside) {
    return placeProbes(scene, count, eye);
}

// Six slabs around the inside of a room.
Scene closedRoom(const vec3& half) {
    constexpr float thick = 0.1F;
    Scene scene;
    const uint32_t material = builtin::addMaterial(scene, lambertMaterial(vec3(0.5F)));
    for (int axis = 0; axis < 3; ++axis) {
        vec3 slab = half + 2.0F * thick;
        slab[axis] = thick;
        vec3 out(0.0F);
        out[axis] = half[axis] + thick;
        builtin::place(scene, "wall", material, builtin::box(slab), builtin::at(out));
        builtin::place(scene, "wall", material, builtin::box(slab), builtin::at(-out));
    }
    return scene;
}

void expectNear(const vec3& a, const vec3& b, float margin) {
    EXPECT_LT(glm::length(a - b), margin) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(PlaceProbes, OneInARoomHasItsWallsForABox) {
    const vec3 half(2.0F, 1.5F, 3.0F);
    const auto probes = placed(closedRoom(half), 1);
    ASSERT_EQ(probes.size(), 1U);
    EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(probes[0].position), 0.8F * half))) << "clear of the walls";
    expectNear(probes[0].box.min, -half, 2e-3F);
    expectNear(probes[0].box.max, half, 2e-3F);
}

TEST(PlaceProbes, ThingsInTheRoomDoNotMakeTheBoxSmaller) {
    const vec3 half(2.0F, 1.5F, 3.0F);
    Scene scene = closedRoom(half);
    builtin::place(scene, "post", 0, builtin::box({0.1F, 1.5F, 0.1F}), builtin::at({0.05F, 0, -1.5F}));
    const auto probes = placed(scene, 1);
    expectNear(probes.at(0).box.min, -half, 2e-3F);
}

TEST(PlaceProbes, OneThatWouldStandInABlockStandsBesideIt) {
    Scene scene = closedRoom({2.0F, 1.5F, 3.0F});
    builtin::place(scene, "block", 0, builtin::box({0.8F, 0.9F, 0.7F}));
    const auto probes = placed(scene, 1);
    const vec3 p = probes.at(0).position;
    EXPECT_GT(std::max({std::abs(p.x) - 0.8F, std::abs(p.y) - 0.9F, std::abs(p.z) - 0.7F}), 0.1F);
    EXPECT_LT(std::abs(p.x), 2.0F);
    EXPECT_LT(std::abs(p.y), 1.5F);
    EXPECT_LT(std::abs(p.z), 3.0F);
}

// Both sides of the block are drawn, and nothing but the camera's place tells whether it is a thing or a room.
TEST(PlaceProbes, AClosedMeshThatIsDrawnFromBothSidesIsARoomIfTheCameraIsInIt) {
    Scene scene = closedRoom({2.0F, 1.5F, 3.0F});
    Material both = lambertMaterial(vec3(0.5F));
    both.doubleSided = true;
    builtin::place(scene, "block", builtin::addMaterial(scene, both), builtin::box({0.8F, 0.9F, 0.7F}));
    const vec3 beside = placed(scene, 1).at(0).position;
    EXPECT_GT(std::max({std::abs(beside.x) - 0.8F, std::abs(beside.y) - 0.9F, std::abs(beside.z) - 0.7F}), 0.1F);
    expectNear(placed(scene, 1, vec3(0.3F, -0.2F, 0.1F)).at(0).position, vec3(0.0F), 1e-3F);
}

TEST(PlaceProbes, ASingleObjectHasNoneNorARoomThatTheCameraSeesFromOutside) {
    for (const bool doubleSided : {false, true}) {
        Scene scene;
        Material material = lambertMaterial(vec3(0.5F));
        material.doubleSided = doubleSided;
        builtin::place(scene, "block", builtin::addMaterial(scene, material), builtin::box({0.8F, 0.9F, 0.7F}));
        EXPECT_TRUE(placed(scene, 4, outside).empty()) << doubleSided;
    }
    EXPECT_TRUE(placed(closedRoom({2.0F, 1.5F, 3.0F}), 4, outside).empty());
}

// A sheet seen from behind encloses nothing: places under it are not left out.
TEST(PlaceProbes, ASheetThatIsDrawnFromBothSidesHidesNoPlace) {
    Scene scene = closedRoom({2.0F, 1.5F, 3.0F});
    Material both = lambertMaterial(vec3(0.5F));
    both.doubleSided = true;
    builtin::place(scene, "sheet", builtin::addMaterial(scene, both), builtin::ground({3.9F, 5.9F}, {1, 1}, {1, 1}),
                   builtin::at({0, 1.2F, 0}));
    EXPECT_LT(placed(scene, 1, vec3(1.5F, 0.0F, 1.5F)).at(0).position.y, 1.2F);
}

TEST(PlaceProbes, AreAsManyAsAskedForAtMostAndLieAlongTheLongestSides) {
    const Scene scene = closedRoom({8.0F, 1.5F, 2.0F});
    EXPECT_TRUE(placed(scene, 0).empty());
    for (uint32_t count = 1; count <= View::maxProbes; ++count) {
        const auto probes = placed(scene, count);
        EXPECT_GE(probes.size(), 1U);
        EXPECT_LE(probes.size(), count);
        EXPECT_GE(2 * probes.size(), count);
    }
    auto four = placed(scene, 4);
    std::ranges::sort(four, {}, [](const Probe& probe) { return probe.position.x; });
    for (size_t i = 1; i < four.size(); ++i) {
        EXPECT_GT(four[i].position.x, four[i - 1].position.x + 2.0F);
    }
}

// A room of two halves: a wall across it, with a door at one side. No middle of a cell sees both.
TEST(PlaceProbes, EveryPartOfWhatLightsTheCameraHasOne) {
    Scene scene = closedRoom({4.0F, 1.5F, 2.0F});
    builtin::place(scene, "across", 0, builtin::box({0.05F, 1.5F, 1.0F}), builtin::at({1.0F, 0, 1.0F}));
    const auto probes = placed(scene, 6, vec3(-2.0F, 0.5F, 0.0F));
    EXPECT_TRUE(std::ranges::any_of(probes, [](const Probe& probe) { return probe.position.x < 0.9F; }));
    EXPECT_TRUE(std::ranges::any_of(probes, [](const Probe& probe) { return probe.position.x > 1.1F; }));
}

TEST(PlaceProbes, AnEmptySceneHasNone) {
    EXPECT_TRUE(placed({}, 4).empty());
}

TEST(PlaceProbes, EveryBuiltinSceneHasThemInsideOfTheirBoxes) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        for (const Probe& probe : placed(builtin.make(), 16)) {
            EXPECT_TRUE(glm::all(glm::lessThan(probe.box.min, probe.position))) << builtin.name;
            EXPECT_TRUE(glm::all(glm::greaterThan(probe.box.max, probe.position))) << builtin.name;
        }
    }
}

}  // namespace
}  // namespace reflet::test::place_probes_test
