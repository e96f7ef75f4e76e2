// KHR_animation_pointer: what is animated, at which values, and what is said about what cannot be.
#include "base/error.h"
#include "gltf_builder.h"
#include "scene/gltf/pointer.h"
#include "scene/pose.h"

#include <gtest/gtest.h>

#include <limits>

namespace reflet::test::gltf_pointer_test {
namespace {

using nlohmann::json;

/// A channel with keys at 0 s and 2 s, or as many as there are values, two seconds apart.
void animate(GltfBuilder& b, const std::string& pointer, const std::vector<float>& values, const char* type = "SCALAR",
             const char* interpolation = "LINEAR") {
    const size_t each = std::string(interpolation) == "CUBICSPLINE" ? 3 : 1;
    std::vector<float> times(values.size() / GltfBuilder::componentsOf(type) / each);
    for (size_t i = 0; i < times.size(); ++i) {
        times[i] = 2.0F * static_cast<float>(i);
    }
    if (!b.document.contains("animations")) {
        b.document["extensionsUsed"] = {"KHR_animation_pointer"};
        b.add("animations", {{"channels", json::array()}, {"samplers", json::array()}});
    }
    json& animation = b.document["animations"][0];
    const int input = b.addFloats(times, "SCALAR");
    const int output = b.addFloats(values, type);
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()},
         {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

GltfBuilder withMaterial(json material) {
    GltfBuilder b = triangle();
    b.document["meshes"][0]["primitives"][0]["material"] = b.add("materials", std::move(material));
    return b;
}

Material materialOf(const Scene& scene, double time) {
    const ScenePose pose = scenePose(scene, time);
    return materialAt(scene, &pose, 0);
}

TEST(GltfPointer, AMaterialHasTheValuesOfItsKeys) {
    GltfBuilder b = withMaterial({{"emissiveFactor", {1, 0.5, 0}},
                                  {"extensions",
                                   {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
                                    {"KHR_materials_transmission", json::object()}}}});
    const std::string at = "/materials/0/";
    animate(b, at + "pbrMetallicRoughness/baseColorFactor", {1, 0, 0, 1, 0, 0.5F, 1, 1}, "VEC4");
    animate(b, at + "pbrMetallicRoughness/roughnessFactor", {0.25F, 0.75F}, "SCALAR", "STEP");
    animate(b, at + "extensions/KHR_materials_emissive_strength/emissiveStrength", {2, 4});
    animate(b, at + "extensions/KHR_materials_transmission/transmissionFactor", {0, 0, 0, -1, 0, 0}, "SCALAR",
            "CUBICSPLINE");
    animate(b, at + "extensions/KHR_materials_ior/ior", {1.5F, 0.5F});
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(animationDuration(loaded.scene), 2.0);
    Material m = materialOf(loaded.scene, 1.0);
    EXPECT_EQ(m.baseColor, vec4(0.5F, 0.25F, 0.5F, 1.0F));
    EXPECT_EQ(m.roughness, 0.25F);
    EXPECT_EQ(m.emissive, vec3(3.0F, 1.5F, 0.0F)) << "the factor stands still";
    EXPECT_EQ(m.ior, 1.0F) << "none is between 0 and 1";
    EXPECT_EQ(m.transmission.factor, 0.25F) << "0 and 0, arriving with a slope of -1 per second";
    m = materialOf(loaded.scene, 1.999);
    EXPECT_EQ(m.roughness, 0.25F);
    const Scene still = frozen(loaded.scene, 1.0);
    EXPECT_EQ(still.materials[0].baseColor, vec4(0.5F, 0.25F, 0.5F, 1.0F));
    EXPECT_TRUE(still.animations.empty() && still.resting.empty());
}

TEST(GltfPointer, ValuesThatAPropertyDoesNotAllowAreTheNearestThatItDoes) {
    GltfBuilder b = withMaterial({{"extensions", {{"KHR_materials_transmission", json::object()}}}});
    // A spline from 0 to 0 that leaves with a slope of 8 per second: 0.125 · 2 · 8 = 2 at half time.
    animate(b, "/materials/0/extensions/KHR_materials_transmission/transmissionFactor", {0, 0, 8, 0, 0, 0}, "SCALAR",
            "CUBICSPLINE");
    animate(b, "/materials/0/pbrMetallicRoughness/metallicFactor", {-3, 0.5F});
    const Scene scene = load(b).scene;
    EXPECT_EQ(materialOf(scene, 1.0).transmission.factor, 1.0F);
    EXPECT_EQ(materialOf(scene, 0.0).metallic, 0.0F);
    EXPECT_NEAR(materialOf(scene, 0.125).transmission.factor,
                2.0 * 8.0 * (0.0625 * 0.0625 * 0.0625 - 2 * 0.0625 * 0.0625 + 0.0625), 1e-6);
}

TEST(GltfPointer, ATextureTransformMovesItsTextureAlone) {
    GltfBuilder b = triangle();
    const int texture = b.addTexture({255, 255, 255, 255});
    const json transform = {{"KHR_texture_transform", {{"scale", {2, 3}}, {"offset", {0.5, 0}}}}};
    b.document["meshes"][0]["primitives"][0]["material"] =
        b.add("materials",
              {{"pbrMetallicRoughness",
                {{"baseColorTexture", {{"index", texture}, {"extensions", transform}}},
                 {"metallicRoughnessTexture", {{"index", texture}}}}},
               {"extensions",
                {{"KHR_materials_clearcoat",
                  {{"clearcoatFactor", 1}, {"clearcoatTexture", {{"index", texture}, {"extensions", transform}}}}}}}});
    const std::string at = "/materials/0/";
    animate(b, at + "pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset", {0, 0, 4, 2},
            "VEC2");
    animate(b, at + "extensions/KHR_materials_clearcoat/clearcoatTexture/extensions/KHR_texture_transform/rotation",
            {0, glm::pi<float>()});
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    const Material m = materialOf(loaded.scene, 1.0);
    EXPECT_EQ(m.baseColorTexture.uvTransform[0], vec3(2, 0, 2));
    EXPECT_EQ(m.baseColorTexture.uvTransform[1], vec3(0, 3, 1));
    EXPECT_NEAR(glm::distance(m.clearcoat.texture.uvTransform[0], vec3(0, 3, 0.5F)), 0.0F, 1e-6F);
    EXPECT_NEAR(glm::distance(m.clearcoat.texture.uvTransform[1], vec3(-2, 0, 0)), 0.0F, 1e-6F);
    EXPECT_EQ(m.metallicRoughnessTexture.uvTransform[0], vec3(1, 0, 0));
}

/// A triangle below a node with a lamp, a camera, and one with the sun.
GltfBuilder lit() {
    GltfBuilder b = triangle();
    b.document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"color", {1, 0.5, 0.25}}, {"intensity", 8}, {"spot", json::object()}},
        {{"type", "directional"}, {"intensity", 3}}};
    b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
    b.add("cameras",
          {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 10}}}});
    b.addRoot({{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.addRoot({{"camera", 1}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    return b;
}

TEST(GltfPointer, LampsSunsAndCamerasAreAnimated) {
    GltfBuilder b = lit();
    const std::string lights = "/extensions/KHR_lights_punctual/lights/";
    animate(b, lights + "0/intensity", {0, 4});
    animate(b, lights + "0/spot/outerConeAngle", {0.5F, 0.7F});
    animate(b, lights + "0/range", {2, 4});
    animate(b, lights + "1/color", {1, 1, 1, 0, 1, 0}, "VEC3");
    animate(b, "/cameras/0/perspective/yfov", {0.5F, 1.5F});
    animate(b, "/cameras/0/perspective/znear", {0.5F, 1.0F});
    animate(b, "/cameras/1/orthographic/ymag", {1, 2});
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    const Scene& scene = loaded.scene;
    const ScenePose pose = scenePose(scene, 1.0);
    const Lamp lamp = posed(scene.lamps.at(0), pose);
    EXPECT_EQ(lamp.intensity, vec3(2.0F, 1.0F, 0.5F));
    EXPECT_NEAR(lamp.outerAngle, 0.6F, 1e-6F);
    EXPECT_EQ(lamp.range, 3.0F);
    EXPECT_EQ(scene.lamps[0].intensity, vec3(4.0F, 2.0F, 1.0F)) << "the brightest";
    ASSERT_TRUE(scene.sun);
    EXPECT_EQ(posed(*scene.sun, pose).irradiance, vec3(1.5F, 3.0F, 1.5F));
    EXPECT_EQ(posed(scene.cameras.at(0), pose).fovY, 1.0F);
    EXPECT_EQ(posed(scene.cameras.at(0), pose).near, 0.75F);
    EXPECT_EQ(posed(scene.cameras.at(1), pose).orthographicHeight, 3.0F);
    View view = defaultView(scene);
    view.time = 1.5;
    EXPECT_NEAR(posed(view, scene).camera.fovY, 1.25F, 1e-6F);
    view.camera.fovY = 0.3F;
    view.sun.irradiance = vec3(7.0F);
    EXPECT_EQ(posed(view, scene).camera.fovY, 0.3F) << "what the user has set stands";
    EXPECT_EQ(posed(view, scene).sun.irradiance, vec3(7.0F));
}

TEST(GltfPointer, NodesMoveAsWithoutTheExtension) {
    GltfBuilder b = triangle();
    animate(b, "/nodes/0/translation", {0, 0, 0, 4, 0, 0}, "VEC3");
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(vec3(scenePose(loaded.scene, 0.5).objectToWorld[0][3]), vec3(1, 0, 0));
}

TEST(GltfPointer, AHiddenNodeHasNeitherSurfaceNorLightNorWhatIsBelow) {
    GltfBuilder b = lit();
    b.document["nodes"][1]["children"] = {b.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}})};
    b.document["nodes"][1]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
    animate(b, "/nodes/1/extensions/KHR_node_visibility/visible", {0, 1, 0}, "SCALAR", "STEP");
    b.document["accessors"].back() =
        b.document["accessors"][static_cast<size_t>(b.addAccessor<uint8_t>({0, 1, 0}, "SCALAR", ubyteType))];
    b.document["accessors"].erase(b.document["accessors"].size() - 2);
    b.document["animations"][0]["samplers"][0]["output"] = b.document["accessors"].size() - 1;
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    ASSERT_EQ(loaded.scene.instances.size(), 2U);
    for (const double time : {0.0, 1.0, 2.0, 3.0}) {
        const bool visible = time >= 2.0;
        const ScenePose pose = scenePose(loaded.scene, time);
        EXPECT_EQ(glm::determinant(mat3(pose.objectToWorld[1])), visible ? 1.0F : 0.0F) << time;
        EXPECT_EQ(vec3(pose.objectToWorld[1][3]), vec3(5, 0, 0)) << "so that no bounds grow";
        EXPECT_EQ(glm::determinant(mat3(pose.objectToWorld[0])), 1.0F) << "a sibling";
        EXPECT_EQ(posed(loaded.scene.lamps.at(0), pose).intensity, visible ? vec3(8, 4, 2) : vec3(0.0F));
    }
}

TEST(GltfPointer, ASkinnedMeshIsHiddenWithoutOthersOfItsSkin) {
    GltfBuilder b = bent();
    const json& nodes = b.document["nodes"];
    const auto skinned = std::find_if(nodes.begin(), nodes.end(), [](const json& n) { return n.contains("skin"); });
    const json copy = *skinned;
    const int hidden = b.addRoot(copy);
    animate(b, "/nodes/" + std::to_string(hidden) + "/extensions/KHR_node_visibility/visible", {0, 1}, "SCALAR",
            "STEP");
    const Scene scene = load(b).scene;
    ASSERT_EQ(scene.instances.size(), 2U);
    const ScenePose pose = scenePose(scene, 0.0);
    const auto spread = [&](size_t instance) {
        const auto p = worldPositions(scene, pose, instance);
        return glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    };
    const size_t gone = scene.instances[0].skin != scene.instances[1].skin && spread(0) < spread(1) ? 0 : 1;
    EXPECT_EQ(spread(gone), 0.0F);
    EXPECT_GT(spread(1 - gone), 0.5F);
}

TEST(GltfPointer, WhatIsUsedAtSomeTimeIsKnownAtAllTimes) {
    GltfBuilder b = withMaterial({{"alphaMode", "BLEND"}});
    animate(b, "/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1, 0, 1, 1, 1, 1}, "VEC4");
    animate(b, "/materials/0/extensions/KHR_materials_transmission/transmissionFactor", {0, 1});
    animate(b, "/materials/0/extensions/KHR_materials_ior/ior", {1.5F, 1.25F});
    const Scene scene = load(b).scene;
    EXPECT_TRUE(scene.materials[0].blended) << "opaque at the end alone";
    EXPECT_GT(scene.materials[0].transmission.factor, 0.0F);
    EXPECT_LT(scene.materials[0].transmission.factor, 1.0F);
    EXPECT_TRUE(scene.materials[0].doubleSided) << "a sheet";
    EXPECT_EQ(scene.materials[0].ior, 1.25F);
    EXPECT_EQ(materialOf(scene, 0.0).transmission.factor, 0.0F);
}

TEST(GltfPointer, WhatCannotBeAnimatedIsToldOnceByItsPointer) {
    GltfBuilder b = withMaterial(json::object());
    animate(b, "/materials/0/doubleSided", {0, 1});
    animate(b, "/materials/0/pbrMetallicRoughness/baseColorFactor/2", {0, 1});
    animate(b, "/nodes/0/name", {0, 1});
    const Loaded loaded = load(b);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_TRUE(
        loaded.warnings[0].ends_with("animations[0].channels[0].target: '/materials/0/doubleSided' will stand "
                                     "still: it cannot be animated (and 2 more)"))
        << loaded.warnings[0];
}

TEST(GltfPointer, HostilePointersAreWarnedOf) {
    const std::string color = "pbrMetallicRoughness/baseColorFactor";
    for (const std::string& pointer :
         std::vector<std::string>{std::string(),
                                  std::string("/"),
                                  std::string("materials"),
                                  std::string("/materials//") + color,
                                  "/materials/-/" + color,
                                  "/materials/00/" + color,
                                  "/materials/-1/" + color,
                                  "/materials/1e0/" + color,
                                  "/materials/1/" + color,
                                  "/materials/4294967296/" + color,
                                  "/materials/99999999999999999999/" + color,
                                  "/materials/0/pbrMetallicRoughness~1baseColorFactor",
                                  "/materials/0/~",
                                  "/materials/0/~2",
                                  "/materials/0/" + std::string(8000, 'a'),
                                  std::string(8000, '/'),
                                  "/nodes/7/translation",
                                  "/nodes/7/extensions/KHR_node_visibility/visible",
                                  "/meshes/3/weights",
                                  "/cameras/0/perspective/yfov",
                                  std::string("/extensions/KHR_lights_punctual/lights/0/color"),
                                  "/materials/0/" + color + std::string(1, '\0'),
                                  std::string("/materials/0/extensions/KHR_texture_transform/offset"),
                                  "/materials/0/" + color + "\n\x1b[31m"}) {
        GltfBuilder b = withMaterial(json::object());
        animate(b, pointer, {1, 1, 1, 1, 0, 0, 0, 0}, "VEC4");
        const Loaded loaded = load(b);
        ASSERT_EQ(loaded.warnings.size(), 1U) << pointer.substr(0, 80);
        EXPECT_LT(loaded.warnings[0].size(), 700U);
        EXPECT_EQ(loaded.warnings[0].find('\x1b'), std::string::npos);
        EXPECT_TRUE(loaded.scene.animations.empty()) << pointer.substr(0, 80);
    }
}

TEST(GltfPointer, KeysOfAnotherTypeAreWarnedOf) {
    const std::string roughness = "/materials/0/pbrMetallicRoughness/roughnessFactor";
    GltfBuilder b = withMaterial(json::object());
    animate(b, roughness, {1, 1, 1, 0, 0, 0}, "VEC3");
    Loaded loaded = load(b);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("has 3 components, but a value of that property has 1"), std::string::npos);

    b = withMaterial(json::object());
    animate(b, roughness, {1, std::numeric_limits<float>::quiet_NaN()});
    EXPECT_NE(load(b).warnings.at(0).find("value 1 is not finite"), std::string::npos);

    b = withMaterial(json::object());
    animate(b, roughness, {1, 0});
    b.document["animations"][0]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]["pointer"] = 5;
    EXPECT_EQ(load(b).warnings.size(), 1U);

    b = withMaterial(json::object());
    animate(b, "/nodes/0/extensions/KHR_node_visibility/visible", {0, 1, 0, 0, 0, 0}, "SCALAR", "CUBICSPLINE");
    EXPECT_NE(load(b).warnings.at(0).find("has splines"), std::string::npos);
}

TEST(GltfPointer, WhatTheSceneDoesNotHaveIsNotAnimated) {
    GltfBuilder b = triangle();
    b.add("materials", json::object());
    animate(b, "/materials/0/pbrMetallicRoughness/roughnessFactor", {0, 1});
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_TRUE(loaded.scene.animations.empty());
}

}  // namespace
}  // namespace reflet::test::gltf_pointer_test
