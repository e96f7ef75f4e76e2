// Small emissive surfaces as sources of light, against closed forms.
#include "scene/emitters.h"

#include "scene/builtin/assemble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet::emitters_test {
namespace {

constexpr float radiance = 50.0F;

Material glowing() {
    Material m = builtin::plain("glow", {0x000000});
    m.emissive = vec3(radiance);
    return m;
}

// Above a ground of 10 metres.
Scene sceneWith(const Material& material, Mesh mesh, const mat4& at = builtin::at({0, 2, 0})) {
    Scene scene;
    builtin::place(scene, "ground", builtin::addMaterial(scene, builtin::plain("ground", {})),
                   builtin::ground({5, 5}, {1, 1}, {1, 1}));
    builtin::place(scene, "light", builtin::addMaterial(scene, material), std::move(mesh), at);
    return scene;
}

float intensityOf(const Emitter& e, const vec3& way) {
    return e.radiance.x * std::max(glm::dot(e.facing, way) + glm::length(e.shape * way), 0.0F);
}

float intensityOf(const SceneEmitters& found, const vec3& way) {
    float sum = 0.0F;
    for (const Emitter& e : found.all) {
        sum += intensityOf(e, glm::normalize(way));
    }
    return sum;
}

TEST(Emitters, OfASphereIsItsProjectedAreaInAllDirections) {
    const SceneEmitters found = findEmitters(sceneWith(glowing(), builtin::sphere(0.05F, 64)), 8);
    ASSERT_EQ(found.all.size(), 1U);
    EXPECT_NEAR(found.all[0].radius, 0.05F, 1e-3F);
    EXPECT_NEAR(found.all[0].softening, 0.0F, 1e-4F);
    EXPECT_NEAR(found.all[0].position.y, 2.0F, 1e-4F);
    for (const vec3& way : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(1, -2, 3)}) {
        EXPECT_NEAR(intensityOf(found, way), radiance * pi * 0.0025F, 0.01F * radiance * pi * 0.0025F);
    }
}

TEST(Emitters, OfAOneSidedPanelFollowsTheCosineAndIsDarkBehind) {
    const Mesh panel = builtin::patch({.right = {0.1F, 0, 0}, .up = {0, 0, 0.2F}});  // faces down
    const SceneEmitters found = findEmitters(sceneWith(glowing(), panel), 8);
    const float most = radiance * 0.08F;
    EXPECT_NEAR(intensityOf(found, {0, -1, 0}), most, 1e-3F * most);
    EXPECT_NEAR(intensityOf(found, {1, -1, 0}), most * std::sqrt(0.5F), 1e-3F * most);
    EXPECT_NEAR(intensityOf(found, {0, 1, 0}), 0.0F, 1e-3F * most);
    EXPECT_NEAR(intensityOf(found, {1, 1, 1}), 0.0F, 1e-3F * most);
}

TEST(Emitters, OfALongTubeAreManyThatTogetherFollowTheSine) {
    const mat4 at = builtin::at({0, 2, 0});
    const SceneEmitters found = findEmitters(sceneWith(glowing(), builtin::cylinder(0.01F, 2.0F, 32), at), 8);
    EXPECT_GE(found.all.size(), 2U);
    const float most = radiance * 0.04F;
    EXPECT_NEAR(intensityOf(found, {1, 0, 0}), most, 0.02F * most);
    EXPECT_NEAR(intensityOf(found, {1, 1, 0}), most * std::sqrt(0.5F), 0.02F * most);
    EXPECT_NEAR(intensityOf(found, {0, 1, 0}), 0.0F, 0.03F * most);
}

TEST(Emitters, OfATextureAreWhereItIsBright) {
    Scene scene = sceneWith(glowing(), builtin::patch({.right = {0.5F, 0, 0}, .up = {0, 0.5F, 0}}));
    TextureImage image{.name = "dot", .width = 32, .height = 32, .rgba = std::vector<uint8_t>(32 * 32 * 4)};
    for (size_t y = 4; y < 8; ++y) {  // a square of 1/64 of the area, in the upper left
        std::fill_n(image.rgba.begin() + static_cast<ptrdiff_t>((y * 32 + 4) * 4), 16, uint8_t(255));
    }
    scene.materials[1].emissiveTexture = builtin::addTexture(scene, std::move(image));
    const SceneEmitters found = findEmitters(scene, 8);
    ASSERT_EQ(found.all.size(), 1U);
    EXPECT_NEAR(found.all[0].position.x, -0.3125F, 0.02F);
    EXPECT_NEAR(found.all[0].position.y, 2.3125F, 0.02F);
    EXPECT_NEAR(intensityOf(found, {0, 0, 1}), radiance / 64.0F, 0.05F * radiance / 64.0F);
}

TEST(Emitters, AreNotLargeSurfacesNorThoseOfOtherLamps) {
    EXPECT_TRUE(findEmitters(sceneWith(glowing(), builtin::sphere(1.0F, 32)), 8).all.empty());
    Scene scene = sceneWith(glowing(), builtin::sphere(0.05F, 32));
    EXPECT_TRUE(findEmitters(scene, 8).materials[1]);
    Lamp strong;
    strong.position = {0, 2, 0};
    strong.intensity = vec3(1000.0F);
    scene.lamps.push_back(strong);
    EXPECT_FALSE(findEmitters(scene, 8).materials[1]);
}

TEST(Emitters, AreMergedIfThereAreMoreThanAllowed) {
    Scene scene = sceneWith(glowing(), builtin::sphere(0.02F, 16));
    for (int i = 0; i < 40; ++i) {
        builtin::place(scene, "another", 1,
                       builtin::at({0.2F * static_cast<float>(i % 8) - 1.0F, 1.0F, 0.3F * static_cast<float>(i / 8)}));
    }
    const SceneEmitters found = findEmitters(scene, 8);
    EXPECT_LE(found.all.size(), 8U);
    const float one = intensityOf(findEmitters(sceneWith(glowing(), builtin::sphere(0.02F, 16)), 8), {0, -1, 0});
    EXPECT_NEAR(intensityOf(found, {0, -1, 0}), 41.0F * one, 0.01F * 41.0F * one);
}

}  // namespace
}  // namespace reflet::emitters_test
