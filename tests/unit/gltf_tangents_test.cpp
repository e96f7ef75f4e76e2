// Tangents that the glTF loader computes for normal maps.
#include "gltf_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet::test::gltf_tangents_test {
namespace {

using nlohmann::json;

/// A square 0..1 in the xy-plane that faces +Z, two triangles, with these uvs and a normal map.
GltfBuilder square(const std::vector<float>& uvs, const json& textureExtensions = json::object()) {
    GltfBuilder b;
    const int positions = b.addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    const int normals = b.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const json texture = {{"index", b.addTexture({128, 128, 255, 255})}, {"extensions", textureExtensions}};
    b.addPrimitive(
        {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", b.addFloats(uvs, "VEC2")}}},
         {"indices", b.addAccessor<uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR", ubyteType)},
         {"material", b.add("materials", {{"normalTexture", texture}})}});
    return b;
}

Mesh meshOf(GltfBuilder builder) {
    return load(std::move(builder)).scene.meshes.at(0);
}

void expectTangents(const Mesh& mesh, const vec4& expected) {
    for (const VertexAttributes& vertex : mesh.attributes) {
        EXPECT_NEAR(glm::distance(vertex.tangent, expected), 0.0F, 1e-6F);
    }
}

TEST(GltfTangents, FollowUAndTheirBitangentIsUpInTheImage) {
    // The image is upright: v grows downwards. cross(+Z, +X) = +Y is up in the image, so w = 1.
    expectTangents(meshOf(square({0, 1, 1, 1, 1, 0, 0, 0})), vec4(1, 0, 0, 1));
}

TEST(GltfTangents, OfAMirroredImageHaveTheOtherHandedness) {
    expectTangents(meshOf(square({1, 1, 0, 1, 0, 0, 1, 0})), vec4(-1, 0, 0, -1));
}

TEST(GltfTangents, TurnWithTheTextureTransform) {
    // The transform's u' = -v grows upwards on the square, v' = u to the right: w · cross(+Z, +Y) = -v' = -X.
    const json quarterTurn = {{"KHR_texture_transform", {{"rotation", -glm::half_pi<double>()}}}};
    expectTangents(meshOf(square({0, 1, 1, 1, 1, 0, 0, 0}, quarterTurn)), vec4(0, 1, 0, 1));
}

TEST(GltfTangents, SplitAVertexWhereHandednessChanges) {
    // The second triangle's image is mirrored in the diagonal that both share.
    const Mesh mesh = meshOf(square({0, 0, 0, 1, 1, 1, 0, 1}));
    EXPECT_EQ(mesh.positions.size(), 6U);
    EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2, 4, 5, 3}));
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(mesh.attributes[mesh.indices[i]].tangent.w, -mesh.attributes[mesh.indices[i + 3]].tangent.w);
    }
    EXPECT_EQ(mesh.positions[4], mesh.positions[0]);
    EXPECT_EQ(mesh.positions[5], mesh.positions[2]);
}

TEST(GltfTangents, SplitAVertexWhereTrianglesWithoutACommonEdgeMeet) {
    // A bow tie; the image is turned on its right wing.
    GltfBuilder b = square({0.5F, 0.5F, 0, 0, 0, 1, 0, 0, 1, 0});
    b.document["meshes"][0]["primitives"][0] = {
        {"attributes",
         {{"POSITION", b.addFloats({0, 0, 0, -1, 1, 0, -1, -1, 0, 1, -1, 0, 1, 1, 0}, "VEC3")},
          {"NORMAL", b.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
          {"TEXCOORD_0", b.addFloats({0.5F, 0.5F, 0, 0, 0, 1, 1, 0, 0, 0}, "VEC2")}}},
        {"indices", b.addAccessor<uint8_t>({0, 1, 2, 0, 3, 4}, "SCALAR", ubyteType)},
        {"material", 0}};
    const Mesh mesh = meshOf(std::move(b));
    ASSERT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2, 5, 3, 4}));
    EXPECT_EQ(mesh.positions[5], mesh.positions[0]);
    EXPECT_NEAR(glm::distance(mesh.attributes[0].tangent, vec4(1, 0, 0, 1)), 0.0F, 1e-6F);
    EXPECT_NEAR(glm::distance(mesh.attributes[5].tangent, vec4(0, -1, 0, 1)), 0.0F, 1e-6F);
}

TEST(GltfTangents, AreMadeOnlyWhereTheMaterialHasANormalMap) {
    GltfBuilder b = square({0, 1, 1, 1, 1, 0, 0, 0});
    b.document["materials"][0] = json::object();
    for (const VertexAttributes& vertex : meshOf(std::move(b)).attributes) {
        EXPECT_EQ(glm::dot(vec3(vertex.tangent), vertex.normal), 0.0F);
    }
}

TEST(GltfTangents, OfTheFileAreKept) {
    GltfBuilder b = square({0, 1, 1, 1, 1, 0, 0, 0});
    b.document["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
        b.addFloats({0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1}, "VEC4");
    expectTangents(meshOf(std::move(b)), vec4(0, 1, 0, -1));
}

TEST(GltfTangents, AreUnitVectorsAtARightAngleWhereTheUvsHaveNoArea) {
    const float huge = 3e38F;
    for (const auto& uvs : {std::vector<float>{0, 0, 0, 0, 0, 0, 0, 0}, std::vector<float>{0, 0, 1, 1, 2, 2, 3, 3},
                            std::vector<float>{-huge, huge, huge, -huge, huge, huge, -huge, -huge},
                            std::vector<float>{std::nanf(""), 0, 1, 0, 1, 1, 0, 1}}) {
        for (const VertexAttributes& vertex : meshOf(square(uvs)).attributes) {
            EXPECT_NEAR(glm::length(vec3(vertex.tangent)), 1.0F, 1e-6F);
            EXPECT_NEAR(glm::dot(vec3(vertex.tangent), vertex.normal), 0.0F, 1e-6F);
            EXPECT_EQ(std::abs(vertex.tangent.w), 1.0F);
        }
    }
}

TEST(GltfTangents, AreTheSameAcrossTrianglesThatShareNoIndex) {
    // Two triangles that share an edge and stretch the image differently; flat normals split all their vertices.
    GltfBuilder b = square({0, 1, 1, 1, 1, 0, 0, 0.25F});
    b.document["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    const Mesh mesh = meshOf(std::move(b));
    ASSERT_EQ(mesh.positions.size(), 6U);
    EXPECT_EQ(mesh.attributes[0].tangent, mesh.attributes[3].tangent);
    EXPECT_EQ(mesh.attributes[2].tangent, mesh.attributes[4].tangent);
    EXPECT_NE(mesh.attributes[1].tangent, mesh.attributes[0].tangent);
}

}  // namespace
}  // namespace reflet::test::gltf_tangents_test
