// glTF scenes: placement by nodes, and warnings.
#include "base/error.h"
#include "gltf_builder.h"

#include <gtest/gtest.h>

namespace reflet::test::gltf_scene_test {
namespace {

using nlohmann::json;

/// A triangle below these nodes; the first is the root.
/// Without one there is nothing to draw, which is an error.
void addMesh(GltfBuilder& b) {
    b.addPrimitive({{"attributes", {{"POSITION", b.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}}}});
}

GltfBuilder withNodes(const json& nodes) {
    GltfBuilder b = triangle();
    b.document["nodes"] = nodes;
    return b;
}

void expectNear(const mat4& actual, const mat4& expected) {
    for (int c = 0; c < 4; ++c) {
        EXPECT_NEAR(glm::distance(actual[c], expected[c]), 0.0F, 1e-6F) << "column " << c;
    }
}

TEST(GltfScene, AMatrixAndTheSameTranslationRotationScalePlaceTheSame) {
    const double s = std::sqrt(0.5);
    const Scene trs = load(withNodes(json::array({{{"mesh", 0},
                                                   {"translation", {5, 6, 7}},
                                                   {"rotation", {0, 0, s, s}},  // a quarter turn about Z
                                                   {"scale", {2, 3, 4}}}})))
                          .scene;
    const mat4 expected(vec4(0, 2, 0, 0), vec4(-3, 0, 0, 0), vec4(0, 0, 4, 0), vec4(5, 6, 7, 1));
    expectNear(trs.instances.at(0).objectToWorld, expected);
    const Scene matrix =
        load(withNodes(json::array({{{"mesh", 0}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}}})))
            .scene;
    EXPECT_EQ(matrix.instances.at(0).objectToWorld, expected);
}

TEST(GltfScene, ChildrenStandInTheirParentsSpace) {
    const Scene scene =
        load(withNodes(json::array({{{"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}, {"children", {1, 2}}},
                                    {{"mesh", 0}, {"name", "a"}, {"translation", {0, 1, 0}}},
                                    {{"mesh", 0}, {"name", "b"}, {"translation", {0, 0, 3}}}})))
            .scene;
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.meshes.size(), 1U);  // shared
    EXPECT_EQ(scene.instances[0].name, "a");
    EXPECT_EQ(vec3(scene.instances[0].objectToWorld[3]), vec3(1, 2, 0));
    EXPECT_EQ(scene.instances[1].name, "b");
    EXPECT_EQ(vec3(scene.instances[1].objectToWorld[3]), vec3(1, 0, 6));
    EXPECT_EQ(scene.instances[1].mesh, 0U);
}

TEST(GltfScene, ANegativeScaleMirrors) {
    const Scene scene = load(withNodes(json::array({{{"mesh", 0}, {"scale", {-1, 2, 3}}}}))).scene;
    EXPECT_EQ(glm::determinant(scene.instances.at(0).objectToWorld), -6.0F);
}

TEST(GltfScene, APrimitiveIsAMeshOfItsOwn) {
    GltfBuilder b = triangle();
    b.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"material", 0}});
    b.add("materials", {{"name", "second"}});
    const Scene scene = load(std::move(b)).scene;
    ASSERT_EQ(scene.meshes.size(), 2U);
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.materials.at(scene.meshes[1].material).name, "second");
    EXPECT_EQ(scene.meshes[1].name, "mesh");
}

TEST(GltfScene, OnlyTheChosenSceneIsLoadedAndTheFileNamesTheDefault) {
    GltfBuilder b = triangle();
    b.add("nodes", {{"mesh", 0}, {"name", "other"}});
    b.add("scenes", {{"name", "second"}, {"nodes", {1}}});
    EXPECT_EQ(load(b).scene.name, "first");
    EXPECT_EQ(load(b, 1).scene.name, "second");
    EXPECT_EQ(load(b, 1).scene.instances.at(0).name, "other");
    EXPECT_THROW(load(b, 2), UsageError);
    b.document["scene"] = 1;
    EXPECT_EQ(load(b).scene.name, "second");
    EXPECT_EQ(load(b, 0).scene.name, "first");
    b.document.erase("scene");
    EXPECT_EQ(load(b).scene.name, "first");
}

TEST(GltfScene, AFileWithoutScenesShowsAllItsNodesWithAWarning) {
    GltfBuilder b = triangle();
    b.document.erase("scenes");
    b.document.erase("scene");
    const Loaded loaded = load(b);
    EXPECT_EQ(loaded.scene.instances.size(), 1U);
    EXPECT_EQ(loaded.scene.name, "scene");
    EXPECT_EQ(loaded.warnings.size(), 1U);
    EXPECT_THROW(load(b, 0), UsageError);
}

json lightNode(int light, json node = json::object()) {
    node["extensions"]["KHR_lights_punctual"]["light"] = light;
    return node;
}

TEST(GltfScene, TheFirstDirectionalLightIsTheSunAndTheOthersAreLamps) {
    const double s = std::sqrt(0.5);
    GltfBuilder b =
        withNodes(json::array({{{"children", {1, 2, 3, 4}}},
                               lightNode(1, {{"translation", {1, 2, 3}}}),
                               lightNode(0, {{"rotation", {-s, 0, 0, s}}}),                       // points down
                               lightNode(2, {{"rotation", {0, s, 0, s}}, {"scale", {2, 2, 2}}}),  // points along -X
                               lightNode(0)}));
    b.document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"color", {1, 0.5, 0.25}}, {"intensity", 4}},
        {{"type", "point"}, {"name", "bulb"}, {"intensity", 10}, {"range", 5}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}};
    addMesh(b);
    const Scene scene = load(std::move(b)).scene;
    ASSERT_TRUE(scene.sun);
    EXPECT_NEAR(glm::distance(scene.sun->direction, vec3(0, -1, 0)), 0, 1e-6);
    EXPECT_EQ(scene.sun->irradiance, vec3(4, 2, 1));
    ASSERT_EQ(scene.lamps.size(), 3U);
    EXPECT_EQ(scene.lamps[0].type, Lamp::Type::point);
    EXPECT_EQ(scene.lamps[0].name, "bulb");
    EXPECT_EQ(scene.lamps[0].position, vec3(1, 2, 3));
    EXPECT_EQ(scene.lamps[0].intensity, vec3(10));
    EXPECT_EQ(scene.lamps[0].range, 5.0F);
    EXPECT_EQ(scene.lamps[1].type, Lamp::Type::spot);
    EXPECT_NEAR(glm::distance(scene.lamps[1].direction, vec3(-1, 0, 0)), 0, 1e-6);
    EXPECT_EQ(scene.lamps[1].innerAngle, 0.25F);
    EXPECT_EQ(scene.lamps[1].outerAngle, 0.5F);
    EXPECT_EQ(scene.lamps[1].range, 0.0F);
    EXPECT_EQ(scene.lamps[2].type, Lamp::Type::directional);
    EXPECT_EQ(scene.lamps[2].direction, vec3(0, 0, -1));
}

TEST(GltfScene, ALampsRadiusIsReadFromItsExtrasAndMustBeZeroOrMore) {
    const auto withExtras = [](const json& extras) {
        GltfBuilder b = withNodes(json::array({lightNode(0), {{"mesh", 0}}}));
        b.document["scenes"][0]["nodes"] = {0, 1};
        b.document["extensions"]["KHR_lights_punctual"]["lights"] =
            json::array({{{"type", "point"}, {"extras", extras}}});
        return b;
    };
    const auto radiusOf = [&](const json& extras) { return load(withExtras(extras)).scene.lamps.at(0).radius; };
    EXPECT_EQ(radiusOf(json::object({{"radius", 0.25}})), 0.25F);
    EXPECT_EQ(radiusOf(json::object({{"radius", 2}})), 2.0F);
    EXPECT_EQ(radiusOf(json::object({{"size", 1}})), 0.0F);
    EXPECT_EQ(radiusOf("no object"), 0.0F);
    for (const json& wrong : {json(-0.1), json("wide"), json(1e300), json(nullptr)}) {
        const json extras = json::object({{"radius", wrong}});
        expectProblem(withExtras(extras).writeGltf(testFolder() / "scene.gltf"),
                      "extensions.KHR_lights_punctual.lights[0].extras.radius: is ",
                      wrong == -0.1 ? "0 will be used" : "its default will be used");
        EXPECT_EQ(radiusOf(extras), 0.0F);
    }
}

TEST(GltfScene, ACamerasLensIsReadFromItsExtras) {
    const auto withExtras = [](const json& extras) {
        GltfBuilder b = withNodes(json::array({{{"camera", 0}}, {{"mesh", 0}, {"name", "statue"}}}));
        b.document["scenes"][0]["nodes"] = {0, 1};
        b.document["cameras"] = json::array(
            {{{"type", "perspective"}, {"perspective", {{"yfov", 2.0 * std::atan(0.24)}, {"znear", 0.1}}}}});
        b.document["cameras"][0]["extras"] = extras;
        return b;
    };
    const auto cameraOf = [&](const json& extras) { return load(withExtras(extras)).scene.cameras.at(0); };
    const Camera camera = cameraOf({{"f_number", 2}, {"focus", "statue"}, {"blades", 6}, {"blade_rotation", 90}});
    EXPECT_NEAR(camera.apertureRadius, 0.0125F, 1e-6F) << "50 mm at f/2";
    ASSERT_EQ(camera.focus.size(), 1U);
    EXPECT_EQ(camera.focus[0].node, "statue");
    EXPECT_EQ(camera.blades, 6U);
    EXPECT_FLOAT_EQ(camera.bladeRotation, glm::radians(90.0F));
    EXPECT_EQ(cameraOf({{"aperture_radius", 0.1}, {"focus_distance", 3}}).focusDistance, 3.0F);
    EXPECT_EQ(cameraOf("no object").apertureRadius, 0.0F);
    const auto file = testFolder() / "scene.gltf";
    expectProblem(withExtras({{"aperture_radius", 0.1}, {"f_number", 2}}).writeGltf(file),
                  "cameras[0].extras: f_number: cannot be given together with aperture_radius",
                  "the camera will be a pinhole");
    expectProblem(withExtras({{"aperture_radius", -1}}).writeGltf(file), "cameras[0].extras.aperture_radius: is -1",
                  "0 will be used");
    expectProblem(withExtras({{"f_number", 2}, {"focus", "statua"}}).writeGltf(file),
                  "camera ''.extras.focus: no node with a mesh is called 'statua'; did you mean 'statue'?",
                  "the camera will focus automatically");
    EXPECT_TRUE(cameraOf({{"f_number", 2}, {"focus", "statua"}}).focus.empty());
}

TEST(GltfScene, CamerasStandAtTheirNodesAndLookAlongMinusZ) {
    const double s = std::sqrt(0.5);
    GltfBuilder b = withNodes(json::array({{{"children", {1}}, {"translation", {0, 0, 10}}},
                                           {{"camera", 0}, {"rotation", {0, s, 0, s}}, {"translation", {0, 1, 0}}}}));
    b.add("cameras", {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.75}, {"znear", 0.5}}}});
    addMesh(b);
    const Camera camera = load(std::move(b)).scene.cameras.at(0);
    EXPECT_EQ(camera.name, "eye");
    EXPECT_EQ(camera.position, vec3(0, 1, 10));
    EXPECT_NEAR(glm::distance(glm::normalize(camera.target - camera.position), vec3(-1, 0, 0)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(camera.up, vec3(0, 1, 0)), 0, 1e-6);
    EXPECT_EQ(camera.fovY, 0.75F);
    EXPECT_EQ(camera.near, 0.5F);
    EXPECT_EQ(camera.orthographicHeight, 0.0F);
}

TEST(GltfScene, AnOrthographicCameraIsTwiceItsYmagHigh) {
    GltfBuilder b = withNodes(json::array({{{"camera", 0}}}));
    b.add("cameras",
          {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 0}, {"zfar", 50}}}});
    addMesh(b);
    const Camera camera = load(std::move(b)).scene.cameras.at(0);
    EXPECT_EQ(camera.orthographicHeight, 6.0F);
    EXPECT_EQ(camera.far, 50.0F);
    EXPECT_GT(camera.near, 0.0F);
    EXPECT_LT(camera.near, 0.01F);
}

TEST(GltfScene, AFarAwayCameraStillHasATargetApartFromItself) {
    GltfBuilder b = withNodes(json::array({{{"camera", 0}, {"translation", {1e20, 1e9, 0}}, {"scale", {0, 0, 0}}}}));
    b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.75}, {"znear", 0.5}}}});
    addMesh(b);
    const Camera camera = load(std::move(b)).scene.cameras.at(0);
    EXPECT_NE(camera.target, camera.position);
    EXPECT_EQ(glm::length(camera.up), 1.0F);
}

TEST(GltfScene, EachKindOfUnsupportedFeatureIsWarnedOfOnce) {
    GltfBuilder b = triangle();
    b.document["extensionsUsed"] = {"ACME_holograms", "KHR_lights_punctual", "EXT_lights_image_based"};
    b.document["skins"] = json::array({{{"joints", {0}}}});
    b.document["nodes"][0]["skin"] = 0;
    b.addRoot({{"mesh", 0}, {"skin", 0}});
    const std::vector<std::string> warnings = load(std::move(b)).warnings;
    const std::vector<std::string> expected{
        "the extension will be ignored: ACME_holograms is not supported",
        "image-based light will be missing: EXT_lights_image_based is not supported",
        "the mesh will not be deformed: it has no JOINTS_0 and WEIGHTS_0"};
    ASSERT_EQ(warnings.size(), expected.size());
    for (size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NE(warnings[i].find(expected[i]), std::string::npos) << warnings[i];
    }
}

TEST(GltfScene, IntegersMayBeWrittenWithAFraction) {
    GltfBuilder b = triangle();
    std::string text = b.gltfBytes();
    const size_t at = text.find("\"mesh\":0");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 8, "\"mesh\":0.0");
    const auto path = testFolder() / "scene.gltf";
    writeBytes(path, text);
    EXPECT_EQ(load(path).scene.instances.size(), 1U);
}

}  // namespace
}  // namespace reflet::test::gltf_scene_test
