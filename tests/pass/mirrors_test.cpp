// Selection of the mirrors that get planar reflections.
#include "renderer/planar_views/mirrors.h"

#include "pass/mirror_room.h"

namespace reflet::test::mirrors_test {
namespace {

ViewParams paramsOf(const View& view) {
    return makeViewParams(view.camera, {160, 90}, 0, 0);
}

std::vector<Mirror> planned(const Scene& scene, const View& view, const PlanarSettings& settings = {},
                            const std::vector<std::string>& names = {}) {
    return planMirrors(findFlatPieces(scene), paramsOf(view), names, settings);
}

TEST(Mirrors, TheMirrorIsFoundWithItsPlaneItsSidesAndItsPlaceOnTheScreen) {
    const std::vector<Mirror> mirrors = planned(makeMirrorRoom(), viewOfMirrorRoom());
    ASSERT_EQ(mirrors.size(), 1U);
    const Mirror& m = mirrors[0];
    EXPECT_LT(glm::length(m.plane - vec4(0, 0, 1, 2)), 1e-5F);
    EXPECT_LT(glm::length(m.right - vec3(1, 0, 0)), 1e-5F);
    EXPECT_LT(glm::length(m.up - vec3(0, 1, 0)), 1e-5F);
    EXPECT_LT(glm::length(m.low - vec2(-2.5F, 0.1F)) + glm::length(m.high - vec2(2.5F, 2.9F)), 1e-4F);
    EXPECT_LT(glm::length(pointOn(m, m.high) - vec3(2.5F, 2.9F, -2)), 1e-4F);
    EXPECT_GT(m.area, 0.15F);
    EXPECT_LT(m.area, (m.uvHigh.x - m.uvLow.x) * (m.uvHigh.y - m.uvLow.y));
    const ViewParams view = paramsOf(viewOfMirrorRoom());
    const vec4 corner = view.worldToClip * vec4(-2.5F, 2.9F, -2, 1);
    EXPECT_NEAR(0.5F + 0.5F * corner.x / corner.w, m.uvLow.x, 1e-4F);
}

TEST(Mirrors, RoughOnesAreNotFoundUnlessTheyAreNamed) {
    const Scene scene = makeMirrorRoom({.roughness = 0.5F});
    EXPECT_TRUE(planned(scene, viewOfMirrorRoom()).empty());
    EXPECT_EQ(planned(scene, viewOfMirrorRoom(), {}, {"mirror"}).size(), 1U);
    EXPECT_EQ(planned(makeMirrorRoom(), viewOfMirrorRoom(), {}, {"thing"}).size(), 1U);  // the floor
    EXPECT_TRUE(planned(makeMirrorRoom(), viewOfMirrorRoom(), {.autoDetect = 0}).empty());
}

TEST(Mirrors, SidesOfABoxAreMirrorsOnlyWhereTheyFaceTheCamera) {
    Material metal = lambertMaterial(vec3(1.0F));
    metal.roughness = 0.0F;
    View view;
    view.camera.position = {3, 2.5F, 4};
    view.camera.target = vec3(0.0F);
    const std::vector<Mirror> mirrors = planned(sceneOf(metal, builtin::box(vec3(1.0F))), view, {.count = 4});
    ASSERT_EQ(mirrors.size(), 3U);
    EXPECT_LT(glm::length(vec3(mirrors[0].plane) - vec3(0, 0, 1)), 1e-5F);  // the largest first
    for (const Mirror& m : mirrors) {
        EXPECT_GT(glm::dot(m.plane, vec4(view.camera.position, 1.0F)), 0.0F);
    }
    EXPECT_EQ(planned(sceneOf(metal, builtin::box(vec3(1.0F))), view, {.count = 2}).size(), 2U);
}

TEST(Mirrors, RoundThingsAreNone) {
    Material metal = lambertMaterial(vec3(1.0F));
    metal.roughness = 0.0F;
    EXPECT_TRUE(findFlatPieces(sceneOf(metal, builtin::sphere(1.0F, 24))).empty());
    EXPECT_TRUE(findFlatPieces(sceneOf(metal, builtin::cylinder(1.0F, 1.0F, 24))).empty());
}

TEST(Mirrors, PiecesInOnePlaneAreOneAndParallelOnesAreTwo) {
    Material metal = lambertMaterial(vec3(1.0F));
    metal.roughness = 0.0F;
    Scene scene = sceneOf(metal, builtin::ground({1, 1}, {2, 2}, {1, 1}));
    builtin::place(scene, "beside", 0, builtin::at({3, 0, 0}));
    builtin::place(scene, "above", 0, builtin::at({0, 0.1F, -4}));
    View view;
    view.camera.position = {1.5F, 4, 8};
    view.camera.target = {1.5F, 0, 0};
    const std::vector<Mirror> mirrors = planned(scene, view, {.count = 4});
    ASSERT_EQ(mirrors.size(), 2U);
    EXPECT_LT(glm::length(mirrors[0].low - vec2(-1, -1)) + glm::length(mirrors[0].high - vec2(4, 1)), 1e-4F);
}

TEST(Mirrors, DoubleSidedOnesMirrorOnTheSideOfTheCamera) {
    Scene scene = makeMirrorRoom();
    View view = viewOfMirrorRoom();
    view.camera.position = {0, 1.5F, -3.5F};
    EXPECT_TRUE(planned(scene, view).empty());
    scene.materials[scene.meshes[scene.instances[1].mesh].material].doubleSided = true;
    const std::vector<Mirror> mirrors = planned(scene, view);
    ASSERT_EQ(mirrors.size(), 1U);
    EXPECT_LT(glm::length(mirrors[0].plane - vec4(0, 0, -1, -2)), 1e-5F);
    EXPECT_LT(glm::length(pointOn(mirrors[0], mirrors[0].low) - vec3(2.5F, 0.1F, -2)), 1e-4F);
}

TEST(Mirrors, ATexturesMeanRoughnessCounts) {
    Scene scene = makeMirrorRoom({.roughness = 1.0F});
    TextureImage image{"roughness", 2, 1, {0, 0, 0, 255, 0, 51, 0, 255}};  // 0 and 0.2
    scene.materials[scene.meshes[scene.instances[1].mesh].material].metallicRoughnessTexture =
        builtin::addTexture(scene, std::move(image));
    const std::vector<FlatPiece> pieces = findFlatPieces(scene);
    EXPECT_NEAR(pieces[1].roughness, 0.1F, 1e-4F);
}

}  // namespace
}  // namespace reflet::test::mirrors_test
