// EXT_meshopt_compression, EXT_mesh_gpu_instancing and KHR_mesh_quantization against what was put in.
#include "gltf_encoders.h"
#include "scene/pose.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <functional>

namespace reflet::test::gltf_compressed_test {
namespace {

using nlohmann::json;

/// A root node with a mesh of these accessors; indices < 0: none.
void addMesh(GltfBuilder& b, const json& attributes, int indices = -1) {
    json primitive = {{"attributes", attributes}};
    if (indices >= 0) {
        primitive["indices"] = indices;
    }
    b.addPrimitive(primitive);
}

int addCompressedAccessor(GltfBuilder& b, const MeshoptView& view, int type, const char* kind) {
    return b.add("accessors",
                 {{"bufferView", addMeshopt(b, view)}, {"componentType", type}, {"count", view.count}, {"type", kind}});
}

/// n vertices on a curve, and a strip of triangles.
std::vector<float> curve(size_t n) {
    std::vector<float> positions;
    for (size_t i = 0; i < n; ++i) {
        const auto t = static_cast<float>(i);
        positions.insert(positions.end(), {std::sin(t), t / 7.0F, static_cast<float>(i % 2)});
    }
    return positions;
}

TEST(GltfMeshopt, VerticesAndIndicesAreThoseThatWereEncoded) {
    const size_t n = 500;
    const std::vector<float> positions = curve(n);
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i + 2 < n; ++i) {
        indices.insert(indices.end(), {i, i + 1, i + 2});
    }
    for (const size_t stride : {2U, 4U}) {
        for (const bool triangles : {true, false}) {
            GltfBuilder b;
            const int at = addCompressedAccessor(b, meshoptVertices(positions.data(), n, 12), floatType, "VEC3");
            const int corners = addCompressedAccessor(b, meshoptIndices(indices, stride, triangles),
                                                      stride == 2 ? ushortType : uintType, "SCALAR");
            addMesh(b, {{"POSITION", at}}, corners);
            addMeshoptBuffers(b);
            const Loaded loaded = load(b);
            EXPECT_TRUE(loaded.warnings.empty());
            const Mesh& mesh = loaded.scene.meshes.at(0);  // flat: every triangle has vertices of its own
            ASSERT_EQ(mesh.positions.size(), indices.size());
            for (size_t t = 0; t < indices.size(); t += 3) {
                // The encoder of triangles may turn a triangle.
                const vec3 first(positions[indices[t] * 3], positions[indices[t] * 3 + 1],
                                 positions[indices[t] * 3 + 2]);
                EXPECT_TRUE(mesh.positions[t] == first || mesh.positions[t + 1] == first ||
                            mesh.positions[t + 2] == first)
                    << t;
            }
        }
    }
}

TEST(GltfMeshopt, FiltersGiveBackPositionsNormalsAndRotations) {
    GltfBuilder b;
    const std::vector<float> positions{0, 0, 0, 1.5F, 0, 0, 0, -2.25F, 0.125F};
    std::vector<uint32_t> exponents;  // an exponent of two in 8 bits, a mantissa in 24
    for (const float value : positions) {
        exponents.push_back(uint32_t(-3) << 24U |
                            (static_cast<uint32_t>(static_cast<int32_t>(value * 8.0F)) & 0xFFFFFFU));
    }
    const std::vector<float> normals{0, 0, 1, 0, 0.6F, 0, 0.8F, 0, 0, -1, 0, 0};
    std::vector<int8_t> octahedral(12);
    meshopt_encodeFilterOct(octahedral.data(), 3, 4, 8, normals.data());
    const int at = addCompressedAccessor(b, meshoptVertices(exponents.data(), 3, 12, "EXPONENTIAL"), floatType, "VEC3");
    const int up = addCompressedAccessor(b, meshoptVertices(octahedral.data(), 3, 4, "OCTAHEDRAL"), byteType, "VEC3");
    b.document["accessors"][up]["normalized"] = true;
    b.document["bufferViews"][1]["byteStride"] = 4;
    addMesh(b, {{"POSITION", at}, {"NORMAL", up}});
    const std::vector<float> turns{0, 0, 0, 1, 0, 0.6F, 0, 0.8F, 0.5F, 0.5F, 0.5F, 0.5F, 0, 0, 1, 0};
    std::vector<int16_t> quaternions(16);
    meshopt_encodeFilterQuat(quaternions.data(), 4, 8, 16, turns.data());
    const int rotation =
        addCompressedAccessor(b, meshoptVertices(quaternions.data(), 4, 8, "QUATERNION"), shortType, "VEC4");
    b.document["accessors"][rotation]["normalized"] = true;
    b.document["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", {{"ROTATION", rotation}}}}}};
    addMeshoptBuffers(b);
    const Scene scene = load(b).scene;
    ASSERT_EQ(scene.instances.size(), 4U);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(scene.meshes[0].positions[i], vec3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]));
        const vec3 normal(normals[4 * i], normals[4 * i + 1], normals[4 * i + 2]);
        EXPECT_GT(glm::dot(scene.meshes[0].attributes[i].normal, normal), 0.999F);
    }
    for (size_t i = 0; i < 4; ++i) {
        const glm::quat expected(turns[4 * i + 3], turns[4 * i], turns[4 * i + 1], turns[4 * i + 2]);
        const mat3 difference = mat3(scene.instances[i].objectToWorld) - glm::mat3_cast(expected);
        EXPECT_LT(glm::length(difference[0]) + glm::length(difference[1]) + glm::length(difference[2]), 1e-3F) << i;
    }
}

TEST(GltfMeshopt, WhatItDemandsIsCheckedBeforeTheDecoderRuns) {
    const auto starts = [](const char* name, const json& value, const std::string& part, const std::string& says) {
        GltfBuilder b = compressed();
        b.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][name] = value;
        const std::string message = complaint(b.writeGltf(testFolder() / "a.gltf"));
        EXPECT_EQ(message.rfind("bufferViews[0].extensions.EXT_meshopt_compression" + part, 0), 0U) << message;
        EXPECT_NE(message.find(says), std::string::npos) << message;
    };
    starts("buffer", 2, ".buffer", "is 2, but there are 2 buffers");
    starts("buffer", 1, ": ", "reaches past the 0 bytes");
    starts("byteOffset", 1 << 20, ": ", "reaches past");
    starts("byteLength", 9007199254740992U, ": ", "reaches past");
    starts("byteLength", 3, ": ", "its compressed data is broken");
    starts("byteStride", 10, ".byteStride", "is not allowed for ATTRIBUTES");
    starts("byteStride", 512, ".byteStride", "not between 1 and 256");
    starts("count", 4, ": ", "decodes to 48 bytes, but the view has 36");
    starts("count", 9007199254740992U, ": ", "decodes to");
    starts("mode", "POINTS", ".mode", "not one of");
    starts("mode", "TRIANGLES", ".byteStride", "is not allowed for TRIANGLES");
    starts("filter", "QUATERNION", ".filter", "is not allowed for ATTRIBUTES of 12 bytes");
    GltfBuilder b = compressed();
    auto& view = b.document["bufferViews"][0];
    view["byteLength"] = 12ULL << 30U;
    view["extensions"]["EXT_meshopt_compression"]["count"] = 1ULL << 30U;
    EXPECT_NE(complaint(b.writeGltf(testFolder() / "a.gltf")).find("claims to decode"), std::string::npos);
}

TEST(GltfInstancing, DrawsACopyForEachElementWhereItsNodePutsIt) {
    GltfBuilder b = triangle();
    const int places = b.addFloats({0, 0, 0, 10, 0, 0}, "VEC3");
    const int turns = b.addAccessor<int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170}, "VEC4", shortType);
    b.document["accessors"][turns]["normalized"] = true;
    const int sizes = b.addFloats({1, 1, 1, 2, 3, 4}, "VEC3");
    b.document["nodes"][0]["translation"] = {0, 0, 5};
    b.document["nodes"][0]["extensions"] = {
        {"EXT_mesh_gpu_instancing",
         {{"attributes", {{"TRANSLATION", places}, {"ROTATION", turns}, {"SCALE", sizes}, {"_ID", places}}}}}};
    b.document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    b.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    ASSERT_EQ(loaded.scene.instances.size(), 2U);
    EXPECT_EQ(loaded.scene.instances[0].mesh, loaded.scene.instances[1].mesh);
    const ScenePose pose = scenePose(loaded.scene, 0.0);
    EXPECT_EQ(worldPositions(loaded.scene, pose, 0)[1], vec3(1, 0, 5));
    const auto second = worldPositions(loaded.scene, pose, 1);  // scaled, then turned by 90 degrees about z
    EXPECT_NEAR(glm::distance(second[1], vec3(10, 2, 5)), 0.0F, 1e-3F);
    EXPECT_NEAR(glm::distance(second[2], vec3(7, 0, 5)), 0.0F, 1e-3F);
}

TEST(GltfInstancing, CopiesMoveWithTheirNodeAndMorphTogether) {
    GltfBuilder b = slider();  // from x = 0 to 4 in 2 s
    b.document["nodes"][0]["extensions"] = {
        {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", b.addFloats({0, 1, 0, 0, 2, 0}, "VEC3")}}}}}};
    Scene scene = load(b).scene;
    EXPECT_EQ(worldPositions(scene, scenePose(scene, 1.0), 1)[0], vec3(2, 2, 0));
    EXPECT_EQ(worldPositions(scene, scenePose(scene, 0.5), 0)[0], vec3(1, 1, 0));
    b = morphing();
    b.document["nodes"][0]["extensions"] = {
        {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", b.addFloats({0, 1, 0, 0, 2, 0}, "VEC3")}}}}}};
    scene = load(b).scene;
    EXPECT_EQ(worldPositions(scene, scenePose(scene, 1.0), 1)[2], vec3(0, 3, 1));
}

TEST(GltfInstancing, InvalidAttributesAreErrors) {
    const auto complaintOf = [](const std::function<json(GltfBuilder&)>& attributes) {
        GltfBuilder b = triangle();
        const json made = attributes(b);
        b.document["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", made}}}};
        return complaint(b.writeGltf(testFolder() / "a.gltf"));
    };
    const std::string part = "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes";
    EXPECT_EQ(complaintOf([](GltfBuilder& b) {
                  return json{{"TRANSLATION", b.addFloats({1, 2, 3}, "VEC3")},
                              {"SCALE", b.addFloats({1, 2, 3, 4, 5, 6}, "VEC3")}};
              }),
              part + ": have 1 and 2 elements, must have as many");
    EXPECT_EQ(complaintOf([](GltfBuilder& b) {
                  return json{{"ROTATION", b.addFloats({1, 2, 3}, "VEC3")}};
              }),
              part + ".ROTATION: is not an accessor of VEC4 floats or small integers");
    EXPECT_EQ(complaintOf([](GltfBuilder& b) {
                  return json{{"TRANSLATION", b.addFloats({1, 2, INFINITY}, "VEC3")}};
              }),
              part + ".TRANSLATION: value 0 is not finite");
    EXPECT_EQ(complaintOf([](GltfBuilder&) {
                  return json{{"TRANSLATION", 99}};
              }),
              part + ".TRANSLATION: is 99, but there are 1 accessors");
}

TEST(GltfQuantization, IntegersArePositionsNormalsAndTextureCoordinates) {
    GltfBuilder b;
    const auto add = [&](const auto& values, const char* type, int component, bool normalized, size_t stride,
                         size_t count) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        const int accessor = b.add(
            "accessors", {{"bufferView", b.addView(values.data(), values.size() * sizeof(T), static_cast<int>(stride))},
                          {"componentType", component},
                          {"normalized", normalized},
                          {"count", count},
                          {"type", type}});
        return accessor;
    };
    const int positions =
        add(std::vector<int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, -32768, 0}, "VEC3", shortType, true, 8, 3);
    const int normals =
        add(std::vector<int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, "VEC3", byteType, true, 4, 3);
    const int uvs = add(std::vector<uint16_t>{0, 0, 65535, 0, 0, 13107}, "VEC2", ushortType, true, 4, 3);
    const int plain = add(std::vector<uint8_t>{0, 0, 0, 0, 3, 0, 0, 0, 0, 7, 0, 0}, "VEC2", ubyteType, false, 4, 3);
    addMesh(b, {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}, {"TEXCOORD_1", plain}});
    b.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scene scene = load(b).scene;
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, -1}}));
    EXPECT_EQ(mesh.attributes[0].normal, vec3(0, 0, 1));
    EXPECT_EQ(mesh.attributes[1].uv0, vec2(1, 0));
    EXPECT_EQ(mesh.attributes[2].uv0, vec2(0, 0.2F));
    EXPECT_EQ(mesh.attributes[1].uv1, vec2(3, 0));
    EXPECT_EQ(mesh.attributes[2].uv1, vec2(0, 7));
}

}  // namespace
}  // namespace reflet::test::gltf_compressed_test
