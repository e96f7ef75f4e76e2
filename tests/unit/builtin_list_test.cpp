// The list of built-in scenes, and what the quay and the street are made of.
#include "scene/builtin.h"
#include "scene/emitters.h"
#include "scene/image_suns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace reflet::test::builtin_list_test {
namespace {

TEST(BuiltinScenes, AllAreListedAndFoundByName) {
    const std::array<std::string_view, 13> names{"cubes",     "tilted-cube", "cornell", "cave",   "gloss",
                                                 "colonnade", "mirror-hall", "lamps",   "moving", "lens",
                                                 "glass",     "quay",        "street"};
    ASSERT_EQ(builtinScenes().size(), names.size());
    for (size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(builtinScenes()[i].name, names[i]);
        ASSERT_EQ(findBuiltinScene(names[i]), &builtinScenes()[i]);
        EXPECT_FALSE(builtinScenes()[i].description.empty());
    }
}

TEST(BuiltinScenes, AnUnknownNameIsNotFound) {
    EXPECT_EQ(findBuiltinScene("no-such-scene"), nullptr);
    EXPECT_EQ(findBuiltinScene(""), nullptr);
    EXPECT_EQ(findBuiltinScene("cube"), nullptr);
}

TEST(BuiltinScenes, TheTessellatedRoomHasAsManyTrianglesAsItsNameSays) {
    for (const size_t wanted : {100U, 400U, 10000U}) {
        const auto scene = makeBuiltinScene("tessellated-" + std::to_string(wanted));
        ASSERT_TRUE(scene);
        size_t indices = 0;
        for (const Instance& instance : scene->instances) {
            indices += scene->meshes[instance.mesh].indices.size();
        }
        EXPECT_EQ(indices, 3 * wanted);
        EXPECT_EQ(scene->bounds().max, makeBuiltinScene("tessellated-100")->bounds().max);
    }
    for (const char* name :
         {"tessellated-", "tessellated-0", "tessellated-101", "tessellated-200", "tessellated-1020100",
          "tessellated-100x", "tessellated", "cube", "motion-", "motion-cube"}) {
        EXPECT_FALSE(makeBuiltinScene(name)) << name;
    }
    EXPECT_EQ(makeBuiltinScene("cubes")->name, findBuiltinScene("cubes")->make().name);
}

TEST(BuiltinQuay, HasWhatIsHard) {
    const Scene scene = findBuiltinScene("quay")->make();
    EXPECT_GT(scene.bounds().size().z, 250.0F);
    const ImageSuns suns = findImageSuns(*scene.environment.image);
    ASSERT_EQ(suns.suns.size(), 1U);
    EXPECT_LT(suns.suns.front().angularDiameter, glm::radians(3.0F));
    EXPECT_GE(findEmitters(scene, 1024).all.size(), 20U);  // those of the posts, and the lantern
    EXPECT_TRUE(std::ranges::any_of(scene.lamps, [](const Lamp& lamp) { return lamp.node >= 0; }));
    EXPECT_LE(scene.lamps.size(), 8U);  // as many as have shadows by default
    const auto movesAndBlends = [&](const Instance& instance) {
        return instance.node >= 0 && scene.materials[scene.meshes[instance.mesh].material].blended;
    };
    EXPECT_GT(std::ranges::count_if(scene.instances, movesAndBlends), 10);
}

TEST(BuiltinStreet, IsLargeAndHasPuddlesNeonLampsAndACarWithAClearCoat) {
    const Scene scene = findBuiltinScene("street")->make();
    size_t triangles = 0;
    for (const Instance& instance : scene.instances) {
        triangles += scene.meshes[instance.mesh].indices.size() / 3;
    }
    EXPECT_GT(triangles, 250000U);
    EXPECT_LT(triangles, 350000U);
    size_t bytes = scene.environment.image->data.size() * sizeof(float);
    for (const Mesh& mesh : scene.meshes) {
        bytes += mesh.positions.size() * (sizeof(vec3) + sizeof(VertexAttributes)) + mesh.indices.size() * 4;
    }
    for (const TextureImage& image : scene.images) {
        bytes += image.rgba.size();
    }
    EXPECT_LT(bytes, 20'000'000U);
    EXPECT_GE(findEmitters(scene, 1024).all.size(), 10U);
    EXPECT_LE(scene.lamps.size(), 8U);  // as many as have shadows by default
    EXPECT_TRUE(std::ranges::all_of(scene.lamps, [](const Lamp& lamp) { return lamp.radius > 0.0F; }));
    EXPECT_TRUE(std::ranges::any_of(scene.materials, [](const Material& m) { return m.clearcoat.factor == 1.0F; }));
    const auto road = std::ranges::find(scene.materials, "wet asphalt", &Material::name);
    ASSERT_NE(road, scene.materials.end());
    const TextureImage& wetness = scene.images[static_cast<size_t>(road->metallicRoughnessTexture.image)];
    size_t smooth = 0;
    size_t rough = 0;
    for (size_t i = 1; i < wetness.rgba.size(); i += 4) {
        smooth += wetness.rgba[i] < 12 ? 1 : 0;
        rough += wetness.rgba[i] > 40 ? 1 : 0;
    }
    EXPECT_GT(10 * smooth, wetness.rgba.size() / 4);  // puddles
    EXPECT_GT(3 * rough, wetness.rgba.size() / 4);
}

}  // namespace
}  // namespace reflet::test::builtin_list_test
