// What is drawn of glTF files with invalid parts, and what the warnings say.
#include "base/error.h"
#include "gltf_builder.h"
#include "valid_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet::test::gltf_forgiving_test {
namespace {

using nlohmann::json;
using Vertices = std::vector<vec3>;
using Indices = std::vector<uint32_t>;

/// The warnings without "FILE: ".
std::vector<std::string> warningsOf(const Loaded& loaded) {
    std::vector<std::string> result;
    for (const std::string& warning : loaded.warnings) {
        result.push_back(warning.substr(warning.find("scene.gltf: ") + 12));
    }
    return result;
}

/// A triangle below these nodes; the scene lists these roots.
Loaded loadNodes(const json& nodes, const json& roots) {
    GltfBuilder b = triangle();
    b.document["nodes"] = nodes;
    b.document["scenes"][0]["nodes"] = roots;
    Loaded loaded = load(std::move(b));
    expectValid(loaded.scene);
    return loaded;
}

/// The x of each instance.
std::vector<float> placesOf(const Scene& scene) {
    std::vector<float> result;
    for (const Instance& instance : scene.instances) {
        result.push_back(instance.objectToWorld[3].x);
    }
    return result;
}

json movedBy(int x, json node = json::object()) {
    node["mesh"] = 0;
    node["translation"] = {x, 0, 0};
    return node;
}

TEST(GltfForgiving, ARootThatIsAlsoAChildIsDrawnOnceBelowItsParent) {
    const Loaded loaded = loadNodes({movedBy(1, {{"children", {1}}}), movedBy(10)}, {1, 0});
    EXPECT_EQ(placesOf(loaded.scene), (std::vector<float>{1, 11}));
    EXPECT_EQ(warningsOf(loaded), (std::vector<std::string>{"scenes[0].nodes: the node will be drawn once: lists "
                                                            "nodes[1], which is the child of another node"}));
}

TEST(GltfForgiving, ARootWhoseParentIsNotInTheSceneIsDrawnWithoutIt) {
    const Loaded loaded =
        loadNodes({movedBy(1, {{"children", {1}}}), movedBy(10, {{"children", {2}}}), movedBy(100)}, {2, 1});
    EXPECT_EQ(placesOf(loaded.scene), (std::vector<float>{10, 110}));
    EXPECT_EQ(warningsOf(loaded),
              (std::vector<std::string>{"scenes[0].nodes: the node will be drawn once: lists "
                                        "nodes[2], which is the child of another node (and 1 more)"}));
}

TEST(GltfForgiving, ANodeWithTwoParentsIsDrawnBelowTheFirst) {
    const Loaded loaded =
        loadNodes({movedBy(1, {{"children", {2}}}), movedBy(2, {{"children", {2}}}), movedBy(10)}, {1, 0});
    EXPECT_EQ(placesOf(loaded.scene), (std::vector<float>{2, 1, 11}));
    ASSERT_EQ(loaded.warnings.size(), 1U);
}

TEST(GltfForgiving, ACycleIsDrawnFromTheNodeThatTheSceneLists) {
    const Loaded loaded = loadNodes({movedBy(1, {{"children", {1}}}), movedBy(10, {{"children", {0}}})}, {1});
    EXPECT_EQ(placesOf(loaded.scene), (std::vector<float>{10, 11}));
    EXPECT_EQ(
        warningsOf(loaded),
        (std::vector<std::string>{"nodes[1]: the node will be drawn as a root: is in a cycle of nodes, or below one"}));
}

TEST(GltfForgiving, AnimatedNodesThatBecomeRootsMoveAsTheyAreDrawn) {
    GltfBuilder b = slider();
    b.document["nodes"] = json::array({{{"children", {1}}, {"translation", {100, 0, 0}}}, {{"mesh", 0}}});
    b.document["scenes"][0]["nodes"] = {1};
    b.document["animations"][0]["channels"][0]["target"]["node"] = 1;
    const Scene scene = load(std::move(b)).scene;
    expectValid(scene);
    EXPECT_EQ(scene.nodes.at(static_cast<size_t>(scene.instances.at(0).node)).parent, -1);
}

TEST(GltfForgiving, AMissingImageLeavesTheFactorAndIsWarnedOfOnceWithACount) {
    GltfBuilder b = triangle();
    b.add("images", {{"uri", "gone.png"}});
    b.add("textures", {{"source", 0}});
    b.add("textures", {{"source", 0}});
    const json pbr = {{"baseColorFactor", {1, 0.5, 0, 1}}, {"baseColorTexture", {{"index", 0}}}};
    b.document["meshes"][0]["primitives"][0]["material"] =
        b.add("materials", {{"pbrMetallicRoughness", pbr},
                            {"normalTexture", {{"index", 1}}},
                            {"emissiveTexture", {{"index", b.addTexture({1, 2, 3, 4})}}}});
    const Loaded loaded = load(std::move(b));
    const Material& m = loaded.scene.materials.at(0);
    EXPECT_EQ(m.baseColor, vec4(1, 0.5, 0, 1));
    EXPECT_EQ(m.baseColorTexture.image, -1);
    EXPECT_EQ(m.normalTexture.image, -1);
    EXPECT_EQ(m.emissiveTexture.image, 0);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("images[0].uri: the texture will be left out: there is no file "),
              std::string::npos);
    EXPECT_TRUE(loaded.warnings[0].ends_with(" (and 1 more)")) << loaded.warnings[0];
}

/// Two triangles of five vertices.
GltfBuilder twoTriangles(std::vector<float> positions, const std::vector<uint8_t>& indices) {
    GltfBuilder b;
    const int places = b.addFloats(positions, "VEC3");
    const int normals = b.addFloats(std::vector<float>(positions.size(), 1.0F), "VEC3");
    b.addPrimitive({{"attributes", {{"POSITION", places}, {"NORMAL", normals}}},
                    {"indices", b.addAccessor(indices, "SCALAR", ubyteType)}});
    return b;
}

const std::vector<float> row{0, 0, 0, 1, 1, 0, 2, 4, 0, 3, 9, 0, 4, 16, 0};

TEST(GltfForgiving, TrianglesWithInvalidIndicesAreLeftOut) {
    for (const uint8_t invalid : {uint8_t(5), uint8_t(255)}) {
        const Loaded loaded = load(twoTriangles(row, {0, invalid, 2, 4, 3, 1}));
        const Mesh& mesh = loaded.scene.meshes.at(0);
        EXPECT_EQ(mesh.positions, (Vertices{{1, 1, 0}, {3, 9, 0}, {4, 16, 0}}));
        EXPECT_EQ(mesh.indices, (Indices{2, 1, 0}));
        EXPECT_EQ(loaded.warnings.size(), 1U);
    }
    EXPECT_EQ(complaint(twoTriangles(row, {0, 9, 2}).writeGltf(testFolder() / "a.gltf"), false),
              "nothing is left to draw: accessors[2]: index 1 is 9, but there are 5 vertices");
}

TEST(GltfForgiving, TrianglesWithPositionsThatAreNotFiniteAreLeftOut) {
    std::vector<float> positions = row;
    positions[6] = std::nanf("");
    const Loaded loaded = load(twoTriangles(positions, {0, 1, 2, 4, 3, 1}));
    expectValid(loaded.scene);
    const Mesh& mesh = loaded.scene.meshes.at(0);
    EXPECT_EQ(mesh.indices, (Indices{4, 3, 1}));
    EXPECT_EQ(mesh.positions[2], mesh.positions[4]) << "an unused vertex must not extend the mesh";
    EXPECT_EQ(mesh.bounds.max, vec3(4, 16, 0));
}

TEST(GltfForgiving, IncompleteTrianglesAreLeftOut) {
    EXPECT_EQ(load(twoTriangles(row, {0, 1, 2, 4, 3})).scene.meshes.at(0).indices, (Indices{0, 1, 2}));
}

TEST(GltfForgiving, OnlyTheInvalidAttributeIsLeftOut) {
    GltfBuilder b = triangle();
    auto& attributes = b.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = b.addFloats({1, 0, 0, 1, 0, 0}, "VEC3");  // one too few
    attributes["TEXCOORD_0"] = b.addFloats({0, 0, 1, 0, 1, 1}, "VEC2");
    attributes["COLOR_0"] = 99;
    const Loaded loaded = load(std::move(b));
    const VertexAttributes& vertex = loaded.scene.meshes.at(0).attributes.at(2);
    EXPECT_EQ(vertex.normal, vec3(0, 0, 1)) << "flat";
    EXPECT_EQ(vertex.uv0, vec2(1, 1));
    EXPECT_EQ(vertex.color, glm::u16vec4(65535));
    EXPECT_EQ(warningsOf(loaded),
              (std::vector<std::string>{"meshes[0].primitives[0].attributes.COLOR_0: the attribute will be missing: is "
                                        "99, but there are 3 accessors",
                                        "meshes[0].primitives[0].attributes.NORMAL: the surface will be faceted: has 2 "
                                        "vertices, but POSITION has 3"}));
}

TEST(GltfForgiving, WithoutOneBufferTheMeshesOfTheOthersAreDrawn) {
    GltfBuilder b = triangle();
    b.add("buffers", {{"byteLength", b.bin.size()}, {"uri", "data:application/octet-stream;base64," + base64(b.bin)}});
    b.add("buffers", {{"byteLength", 36}, {"uri", "gone.bin"}});
    const int view = b.add("bufferViews", {{"buffer", 1}, {"byteLength", 36}});
    json accessor = b.document["accessors"][0];
    accessor["bufferView"] = view;
    b.addPrimitive({{"attributes", {{"POSITION", b.add("accessors", accessor)}}}});
    const Loaded loaded = load(b);
    EXPECT_EQ(loaded.scene.instances.size(), 1U);
    ASSERT_EQ(loaded.warnings.size(), 1U) << "none for the view and the accessor of the missing buffer";
    EXPECT_NE(loaded.warnings[0].find("buffers[1].uri: the primitive will not be drawn: there is no file "),
              std::string::npos);
    b.document["nodes"].erase(0);
    b.document["scenes"][0]["nodes"] = {0};
    const std::string message = complaint(b.writeGltf(testFolder() / "a.gltf"), false);
    EXPECT_EQ(message.rfind("nothing is left to draw: buffers[1].uri: there is no file ", 0), 0U) << message;
}

TEST(GltfForgiving, WhatNothingUsesIsWarnedOf) {
    GltfBuilder b = triangle();
    b.add("accessors", {{"componentType", 5120}, {"count", 1}});
    b.add("bufferViews", {{"buffer", 0}, {"byteOffset", 1000}, {"byteLength", 36}});
    EXPECT_EQ(warningsOf(load(std::move(b))),
              (std::vector<std::string>{"accessors[1].type: nothing is missing, because nothing uses it: is missing",
                                        "bufferViews[1]: nothing is missing, because nothing uses it: reaches 1000 "
                                        "bytes past buffers[0]"}));
}

TEST(GltfForgiving, NumbersAreClamped) {
    GltfBuilder b = triangle();
    b.document["meshes"][0]["primitives"][0]["material"] =
        b.add("materials", {{"pbrMetallicRoughness",
                             {{"baseColorFactor", {2, 0.5, -1, 1}}, {"roughnessFactor", 7}, {"metallicFactor", "x"}}}});
    const Loaded loaded = load(std::move(b));
    const Material& m = loaded.scene.materials.at(0);
    EXPECT_EQ(m.baseColor, vec4(1, 0.5, 0, 1));
    EXPECT_EQ(m.roughness, 1.0F);
    EXPECT_EQ(m.metallic, 1.0F);
    EXPECT_EQ(warningsOf(loaded).at(0),
              "materials[0].pbrMetallicRoughness.baseColorFactor[0]: 1 will be used: is 2, not between 0 and 1 (and 1 "
              "more)");
}

TEST(GltfForgiving, ARequiredExtensionIsToleratedIfItsConsequenceIsKnown) {
    GltfBuilder b = triangle();
    b.document["extensionsUsed"] = {"KHR_materials_future"};
    b.document["extensionsRequired"] = {"KHR_materials_future"};
    const auto path = b.writeGltf(testFolder() / "scene.gltf");
    expectProblem(path, "extensionsRequired: KHR_materials_future is not supported", "materials will look different");
    EXPECT_EQ(load(path).warnings.size(), 1U);
    b.document["extensionsRequired"] = {"ACME_compression"};
    expectProblem(b.writeGltf(path), "extensionsRequired: ACME_compression is not supported", nullptr);
}

std::string padded(std::string text, char with) {
    text.resize((text.size() + 3) / 4 * 4 + 4, with);
    return text;
}

std::string glb(const std::string& text, const std::string& bin) {
    const auto word = [](size_t value) {
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &value, 4);
        return bytes;
    };
    const std::string chunks = word(text.size()) + "JSON" + text + word(bin.size()) + std::string("BIN\0", 4) + bin;
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

TEST(GltfForgiving, SlipsOfGlbWritersAreWarnings) {
    GltfBuilder b = triangle();
    b.add("buffers", {{"byteLength", b.bin.size()}});
    const std::string bin(b.bin.begin(), b.bin.end());
    const std::string text = b.gltfBytes();
    const std::string good = glb(padded(text, ' '), bin);
    const auto path = testFolder() / "scene.glb";
    const auto expectSlip = [&](const std::string& bytes, const char* starts, const char* consequence) {
        writeBytes(path, bytes);
        expectProblem(path, starts, consequence);
    };
    expectSlip(glb(padded(text, '\0'), bin), "JSON: ends with ", "they will be ignored");
    expectSlip(good + "trailing", "GLB header: says the file has ", "what the file has will be read");
    const Loaded trailing = load(path);
    EXPECT_EQ(trailing.scene.meshes.at(0).positions.at(1), vec3(1, 0, 0));
    std::string longChunk = good;
    longChunk[good.size() - bin.size() - 8] = 100;
    expectSlip(longChunk, "GLB chunk: at byte ", "what lies beyond the end of the file will be missing");
    EXPECT_EQ(load(path).scene.meshes.at(0).positions.at(1), vec3(1, 0, 0));
}

TEST(GltfForgiving, AValidFileIsLoadedTheSameEitherWay) {
    const auto path = everything().writeGltf(testFolder() / "scene.gltf");
    EXPECT_EQ(complaint(path, true), "");
    const Loaded loaded = load(path);
    EXPECT_TRUE(loaded.warnings.empty());
    expectValid(loaded.scene);
}

TEST(GltfForgiving, AFileOfProblemsIsRefusedSoon) {
    GltfBuilder b = triangle();
    b.document["nodes"][0]["children"] = json(std::vector<int>(200000, 7));
    EXPECT_EQ(complaint(b.writeGltf(testFolder() / "scene.gltf"), false), "has more than 100000 problems");
}

}  // namespace
}  // namespace reflet::test::gltf_forgiving_test
