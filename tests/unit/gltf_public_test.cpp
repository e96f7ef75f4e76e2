// What files of other programs have: more joints and texture coordinates, visibility, old materials, points and lines,
// extensions that change nothing, and nothing at all.
#include "base/error.h"
#include "gltf_builder.h"
#include "scene/gltf/meshopt_vertices.h"
#include "scene/pose.h"
#include "scene/thin_meshes.h"

#include <gtest/gtest.h>

#include <array>

namespace reflet::test::gltf_public_test {
namespace {

using nlohmann::json;

json& materialOf(GltfBuilder& b) {
    b.document["meshes"][0]["primitives"][0]["material"] = b.add("materials", json::object());
    return b.document["materials"].back();
}

TEST(GltfPublic, AVertexFollowsAllSetsOfJoints) {
    GltfBuilder b = bent();
    json& attributes = b.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] = b.addAccessor<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4", ubyteType);
    attributes["WEIGHTS_1"] = b.addFloats({0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0}, "VEC4");
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    const auto positions = worldPositions(loaded.scene, scenePose(loaded.scene, 0.0), 0);
    EXPECT_NEAR(positions[2].z, 2.0F * 6.0F / 7.0F, 1e-6F) << "of weights 1, 3 and 3";
    EXPECT_EQ(positions[1], vec3(1, 0, 0));
}

TEST(GltfPublic, AMaterialUsesAnyTwoSetsOfTextureCoordinates) {
    GltfBuilder b = triangle();
    json& attributes = b.document["meshes"][0]["primitives"][0]["attributes"];
    for (const int set : {0, 1, 2, 3}) {
        const auto at = static_cast<float>(set);
        attributes["TEXCOORD_" + std::to_string(set)] = b.addFloats({at, 0, at, 0, at, 0}, "VEC2");
    }
    const int texture = b.addTexture({255, 255, 255, 255});
    json& material = materialOf(b);
    material = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}, {"texCoord", 3}}}}},
                {"emissiveTexture", {{"index", texture}, {"texCoord", 1}}}};
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    const Material& m = loaded.scene.materials[0];
    const VertexAttributes& v = loaded.scene.meshes[0].attributes[0];
    EXPECT_EQ((m.baseColorTexture.uvSet == 0 ? v.uv0 : v.uv1).x, 3.0F);
    EXPECT_EQ((m.emissiveTexture.uvSet == 0 ? v.uv0 : v.uv1).x, 1.0F);
}

TEST(GltfPublic, OfThreeSetsOfTextureCoordinatesTheMostVisibleTexturesKeepTheirs) {
    GltfBuilder b = triangle();
    json& attributes = b.document["meshes"][0]["primitives"][0]["attributes"];
    for (const int set : {0, 1, 2, 3}) {
        const auto at = static_cast<float>(set);
        attributes["TEXCOORD_" + std::to_string(set)] = b.addFloats({at, 0, at, 0, at, 0}, "VEC2");
    }
    const int texture = b.addTexture({255, 255, 255, 255});
    materialOf(b) = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}, {"texCoord", 3}}}}},
                     {"normalTexture", {{"index", texture}, {"texCoord", 1}}},
                     {"occlusionTexture", {{"index", texture}, {"texCoord", 0}}},
                     {"emissiveTexture", {{"index", texture}, {"texCoord", 2}}}};
    const Loaded loaded = load(b);
    const Material& m = loaded.scene.materials[0];
    const VertexAttributes& v = loaded.scene.meshes[0].attributes[0];
    const auto setOf = [&](const TextureSlot& slot) { return (slot.uvSet == 0 ? v.uv0 : v.uv1).x; };
    EXPECT_EQ(setOf(m.baseColorTexture), 3.0F);
    EXPECT_EQ(setOf(m.normalTexture), 1.0F);
    EXPECT_EQ(setOf(m.occlusionTexture), 3.0F);
    EXPECT_EQ(setOf(m.emissiveTexture), 3.0F);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_TRUE(loaded.warnings[0].ends_with(
        "materials[0]: occlusionTexture (TEXCOORD_0), emissiveTexture (TEXCOORD_2) will be drawn with TEXCOORD_3: a "
        "material may have two sets, here TEXCOORD_3 and TEXCOORD_1"))
        << loaded.warnings[0];
}

TEST(GltfPublic, ANodeThatIsNotVisibleHidesWhatIsBelowButCameras) {
    GltfBuilder b = triangle();
    b.document["extensionsUsed"] = {"KHR_node_visibility"};
    b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
    const int child = b.add("nodes", {{"mesh", 0}, {"camera", 0}});
    b.addRoot({{"children", {child}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.scene.instances.size(), 1U);
    EXPECT_EQ(loaded.scene.cameras.size(), 1U);
}

TEST(GltfPublic, AlphaThatEqualsTheCutoffIsOpaqueInSpiteOfRounding) {
    GltfBuilder b = triangle();
    materialOf(b) = {{"alphaMode", "MASK"}, {"alphaCutoff", 0.5}};
    const float cutoff = load(b).scene.materials[0].alphaCutoff;
    EXPECT_LT(cutoff, 0.4995F);
    EXPECT_GT(cutoff, 127.0F / 255.0F) << "the next 8-bit value is cut";
}

TEST(GltfPublic, SpecularGlossinessIsConverted) {
    GltfBuilder b = triangle();
    const int texture = b.addTexture({255, 128, 0, 102});
    b.document["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
    materialOf(b) = {{"extensions",
                      {{"KHR_materials_pbrSpecularGlossiness",
                        {{"diffuseFactor", {0.25, 0.5, 0.75, 1}},
                         {"specularFactor", {0.5, 0.25, 1}},
                         {"glossinessFactor", 0.5},
                         {"specularGlossinessTexture", {{"index", texture}}}}}}}};
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    const Material& m = loaded.scene.materials[0];
    EXPECT_EQ(m.baseColor, vec4(0.25F, 0.5F, 0.75F, 1.0F));
    EXPECT_EQ(m.metallic, 0.0F);
    EXPECT_EQ(m.ior, 0.0F) << "reflects its specular colour at normal incidence";
    EXPECT_EQ(m.specularColor, vec3(0.5F, 0.25F, 1.0F));
    ASSERT_GE(m.metallicRoughnessTexture.image, 0);
    const TextureImage& rough = loaded.scene.images[static_cast<size_t>(m.metallicRoughnessTexture.image)];
    EXPECT_EQ(rough.rgba[1], 204) << "1 - 0.5 · 0.4";
    EXPECT_EQ(m.roughness, 1.0F);
}

TEST(GltfPublic, ExtensionsThatChangeNothingAreNotWarnedOf) {
    GltfBuilder b = triangle();
    b.document["extensionsUsed"] = {"FB_ngon_encoding", "EXT_mesh_features", "MSFT_lod"};
    EXPECT_TRUE(load(b).warnings.empty());
}

TEST(GltfPublic, AFileThatLeavesNothingToDrawIsAnErrorThatSaysWhy) {
    const auto why = [](GltfBuilder b) {
        const auto file = testFolder() / "file.gltf";
        b.writeGltf(file);
        return complaint(file, false);
    };
    GltfBuilder empty;
    empty.addRoot({{"name", "alone"}});
    EXPECT_EQ(why(empty), "nothing is left to draw: no node of the scene shows a mesh");
    GltfBuilder custom = triangle();
    custom.document["meshes"][0]["primitives"][0]["attributes"] = {{"_CUSTOM", 0}};
    custom.document["accessors"][0]["componentType"] = 5130;
    EXPECT_EQ(why(custom), "nothing is left to draw: meshes[0].primitives[0].attributes: has no POSITION");
}

TEST(GltfPublic, PointsAndLinesAreAPixelWide) {
    for (const int mode : {0, 1, 2, 3}) {
        GltfBuilder b;
        const int at = b.addFloats({-1, 0, 0, 1, 0, 0, 1, 1, 0, -1, 1, 0}, "VEC3");
        b.addPrimitive({{"attributes", {{"POSITION", at}}}, {"mode", mode}});
        Loaded loaded = load(b);
        EXPECT_TRUE(loaded.warnings.empty());
        Scene& scene = loaded.scene;
        EXPECT_TRUE(scene.materials[0].unlit);
        const size_t elements = mode == 1 ? 2 : mode == 3 ? 3 : 4;
        EXPECT_EQ(scene.meshes[0].indices.size(), elements * (mode == 0 ? 24 : 36)) << mode;
        Camera camera;
        camera.position = {0, 0, 5};
        camera.target = {0, 0, 0};
        widenThinMeshes(scene, camera, 100);
        const float pixel = 2.0F * std::tan(0.5F * camera.fovY) * 5.0F / 100.0F;
        EXPECT_NEAR(scene.meshes[0].bounds.max.z, 0.6F * pixel, 0.2F * pixel) << mode;
    }
}

TEST(GltfPublic, ZMayPointUp) {
    GltfBuilder b = triangle();
    b.document["nodes"][0]["translation"] = {1, 2, 3};
    const auto file = testFolder() / "file.gltf";
    b.writeGltf(file);
    const vec3 place(loadGltf(file, {.variant = {}, .zUp = true, .warn = {}}).instances[0].objectToWorld[3]);
    EXPECT_LT(glm::length(place - vec3(1, 3, -2)), 1e-6F);
}

/// A stream of one block of up to 16 elements of four bytes.
std::vector<uint8_t> stream(uint8_t control, const std::vector<uint8_t>& data, std::array<uint8_t, 4> baseline,
                            uint8_t channel) {
    std::vector<uint8_t> bytes{meshoptVertexHeader1, control};
    bytes.insert(bytes.end(), data.begin(), data.end());
    bytes.resize(bytes.size() + 24 - 5, 0);
    bytes.insert(bytes.end(), baseline.begin(), baseline.end());
    bytes.push_back(channel);
    return bytes;
}

TEST(MeshoptVertices, DecodeTheExampleOfTheSpecification) {
    const std::vector<uint8_t> data{0x03, 0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5};
    std::vector<uint8_t> decoded(64);
    ASSERT_TRUE(decodeMeshoptVertices(stream(0xA8, data, {7, 1, 2, 3}, 0), 4, 16, decoded));
    const std::array<int, 16> deltas{-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0};
    int value = 7;
    for (size_t i = 0; i < deltas.size(); ++i) {
        value += deltas.at(i);
        EXPECT_EQ(decoded[4 * i], static_cast<uint8_t>(value)) << i;
        EXPECT_EQ(decoded[4 * i + 1], 1);
    }
}

TEST(MeshoptVertices, DecodeEveryChannelMode) {
    std::vector<uint8_t> decoded(8);
    // Literal deltas, byte by byte: 0x0003, then 0x0101, of both halves.
    const std::vector<uint8_t> words{0x03, 0x01, 0x00, 0x01, 0x03, 0x01, 0x00, 0x01};
    ASSERT_TRUE(decodeMeshoptVertices(stream(0xFF, words, {0, 1, 0, 2}, 1), 4, 2, decoded));
    EXPECT_EQ(decoded, (std::vector<uint8_t>{0xFE, 0x00, 0xFE, 0x01, 0x7D, 0x00, 0x7D, 0x01})) << "-2, then -129";
    // Turned left by 4 bits.
    ASSERT_TRUE(
        decodeMeshoptVertices(stream(0xFF, {0x01, 0x00, 0, 0, 0, 0, 0xF0, 0}, {0, 0, 0, 0}, 0x42), 4, 2, decoded));
    EXPECT_EQ(decoded, (std::vector<uint8_t>{0x1F, 0, 0, 0, 0x1F, 0, 0, 0}));
    EXPECT_FALSE(decodeMeshoptVertices(stream(0xFF, words, {0, 0, 0, 0}, 3), 4, 2, decoded)) << "no such mode";
    EXPECT_FALSE(decodeMeshoptVertices(stream(0xFF, {1, 2, 3}, {0, 0, 0, 0}, 0), 4, 2, decoded)) << "too short";
}

TEST(MeshoptVertices, DecodeColors) {
    std::vector<uint8_t> color{100, 20, static_cast<uint8_t>(-30), 0x80 | 0x7F};
    decodeMeshoptColors(color, 4);
    EXPECT_EQ(color, (std::vector<uint8_t>{150, 70, 110, 255}));
}

}  // namespace
}  // namespace reflet::test::gltf_public_test
