// glTF geometry: from accessors and primitives to meshes.
#include "gltf_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet::test::gltf_test {
namespace {

using nlohmann::json;
using Vertices = std::vector<vec3>;
using Indices = std::vector<uint32_t>;

/// The only mesh of the file.
Mesh meshOf(GltfBuilder builder) {
    Loaded loaded = load(std::move(builder));
    EXPECT_EQ(loaded.scene.meshes.size(), 1U);
    return loaded.scene.meshes.empty() ? Mesh{} : std::move(loaded.scene.meshes[0]);
}

/// Five vertices at x = index, y = index squared: any three make a non-degenerate triangle.
std::vector<float> row() {
    return {0, 0, 0, 1, 1, 0, 2, 4, 0, 3, 9, 0, 4, 16, 0};
}

Mesh withMode(int mode, bool indexed) {
    GltfBuilder b;
    const int positions = b.addFloats(row(), "VEC3");
    const int normals = b.addFloats(std::vector<float>(15, 1.0F), "VEC3");
    json primitive = {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"mode", mode}};
    if (indexed) {
        primitive["indices"] = b.addAccessor<uint8_t>({4, 3, 2, 1, 0}, "SCALAR", ubyteType);
    }
    b.addPrimitive(primitive);
    return meshOf(std::move(b));
}

TEST(Gltf, TrianglesWithoutIndicesTakeTheVerticesInTheirOrder) {
    const Mesh mesh = meshOf(triangle());
    EXPECT_EQ(mesh.positions, (Vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2}));
    EXPECT_EQ(mesh.bounds.min, vec3(0, 0, 0));
    EXPECT_EQ(mesh.bounds.max, vec3(1, 1, 0));
    EXPECT_EQ(mesh.attributes.size(), 3U);
}

TEST(Gltf, IndicesMayBeOfOneTwoOrFourBytes) {
    const auto withIndices = [](auto indices, int type) {
        GltfBuilder b;
        const int positions = b.addFloats(row(), "VEC3");
        const int normals = b.addFloats(std::vector<float>(15, 1.0F), "VEC3");
        b.addPrimitive({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                        {"indices", b.addAccessor(indices, "SCALAR", type)}});
        return meshOf(std::move(b)).indices;
    };
    const Indices expected{0, 1, 2, 2, 1, 4, 3, 4, 0};
    EXPECT_EQ(withIndices(std::vector<uint8_t>{0, 1, 2, 2, 1, 4, 3, 4, 0}, ubyteType), expected);
    EXPECT_EQ(withIndices(std::vector<uint16_t>{0, 1, 2, 2, 1, 4, 3, 4, 0}, ushortType), expected);
    EXPECT_EQ(withIndices(std::vector<uint32_t>{0, 1, 2, 2, 1, 4, 3, 4, 0}, uintType), expected);
}

TEST(Gltf, AStripTurnsItsOddTrianglesSoThatAllFaceTheSameWay) {
    EXPECT_EQ(withMode(5, false).indices, (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    EXPECT_EQ(withMode(5, true).indices, (Indices{4, 3, 2, 3, 1, 2, 2, 1, 0}));
}

TEST(Gltf, AFanKeepsItsFirstVertexInAllTriangles) {
    EXPECT_EQ(withMode(6, false).indices, (Indices{1, 2, 0, 2, 3, 0, 3, 4, 0}));
    EXPECT_EQ(withMode(6, true).indices, (Indices{3, 2, 4, 2, 1, 4, 1, 0, 4}));
}

TEST(Gltf, OnlyTheVerticesThatTrianglesUseAreKept) {
    GltfBuilder b;
    const int positions = b.addFloats(row(), "VEC3");
    const int normals = b.addFloats(std::vector<float>(15, 1.0F), "VEC3");
    const json attributes = {{"POSITION", positions}, {"NORMAL", normals}};
    b.addPrimitive({{"attributes", attributes}, {"indices", b.addAccessor<uint8_t>({4, 2, 1}, "SCALAR", ubyteType)}});
    const Mesh mesh = meshOf(std::move(b));
    EXPECT_EQ(mesh.positions, (Vertices{{1, 1, 0}, {2, 4, 0}, {4, 16, 0}}));
    EXPECT_EQ(mesh.indices, (Indices{2, 1, 0}));
    EXPECT_EQ(mesh.bounds.min, vec3(1, 1, 0));
}

TEST(Gltf, AFewTrianglesOfALongListOfVerticesKeepOnlyTheirOwn) {
    GltfBuilder b;
    std::vector<float> positions;
    for (int i = 0; i < 1000; ++i) {
        positions.insert(positions.end(), {static_cast<float>(i), static_cast<float>(i % 7), 0.0F});
    }
    const std::vector<uint16_t> indices{900, 3, 500, 500, 3, 4};
    b.addPrimitive({{"attributes",
                     {{"POSITION", b.addFloats(positions, "VEC3")},
                      {"NORMAL", b.addFloats(std::vector<float>(3000, 1.0F), "VEC3")}}},
                    {"indices", b.addAccessor(indices, "SCALAR", ushortType)}});
    const Mesh mesh = meshOf(std::move(b));
    EXPECT_EQ(mesh.positions, (Vertices{{3, 3, 0}, {4, 4, 0}, {500, 3, 0}, {900, 4, 0}}));
    EXPECT_EQ(mesh.indices, (Indices{3, 0, 2, 2, 0, 1}));
}

TEST(Gltf, MissingNormalsAreFlatAndSharedVerticesAreSplit) {
    GltfBuilder b;
    const int positions = b.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    const int tangents = b.addFloats({0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, "VEC4");
    b.addPrimitive({{"attributes", {{"POSITION", positions}, {"TANGENT", tangents}}},
                    {"indices", b.addAccessor<uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR", ubyteType)}});
    const Mesh mesh = meshOf(std::move(b));
    EXPECT_EQ(mesh.positions, (Vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 3, 4, 5}));
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(mesh.attributes[i].normal, i < 3 ? vec3(0, 0, 1) : vec3(1, 0, 0));
        EXPECT_EQ(glm::dot(vec3(mesh.attributes[i].tangent), mesh.attributes[i].normal), 0.0F);
    }
}

TEST(Gltf, NormalsWithoutADirectionComeFromTheTrianglesAndNeverAreNan) {
    const float nan = std::nanf("");
    GltfBuilder b;
    const int positions = b.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5, 5, 5, 5, 5, 5, 5}, "VEC3");
    const int normals = b.addFloats({0, 0, 0, nan, 0, 0, 0, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
    b.addPrimitive({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                    {"indices", b.addAccessor<uint8_t>({0, 1, 2, 3, 4, 5}, "SCALAR", ubyteType)}});
    const Loaded loaded = load(std::move(b));
    const auto& vertices = loaded.scene.meshes[0].attributes;
    EXPECT_EQ(vertices[0].normal, vec3(0, 0, 1));
    EXPECT_EQ(vertices[1].normal, vec3(0, 0, 1));
    EXPECT_EQ(vertices[2].normal, vec3(0, 0.6F, 0.8F));
    EXPECT_EQ(vertices[3].normal, vec3(0, 1, 0));
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("5 vertices will get the normals of their triangles"), std::string::npos);
}

TEST(Gltf, TrianglesWithARepeatedVertexAreLeftOut) {
    GltfBuilder b;
    b.addPrimitive({{"attributes", {{"POSITION", b.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3")}}},
                    {"indices", b.addAccessor<uint8_t>({0, 1, 2, 2, 1, 1, 1, 3, 2}, "SCALAR", ubyteType)},
                    {"mode", 5}});
    EXPECT_EQ(load(std::move(b)).scene.meshes.at(0).indices.size(), 3U * 2U);
}

TEST(Gltf, ADegenerateTriangleHasAFlatNormal) {
    GltfBuilder b;
    b.addPrimitive({{"attributes", {{"POSITION", b.addFloats({1, 1, 1, 1, 1, 1, 2, 2, 2}, "VEC3")}}}});
    for (const VertexAttributes& vertex : meshOf(std::move(b)).attributes) {
        EXPECT_EQ(vertex.normal, vec3(0, 1, 0));
    }
}

TEST(Gltf, ASparseAccessorReplacesElementsOfItsBase) {
    GltfBuilder b = everything();
    const Scene scene = load(std::move(b)).scene;
    ASSERT_EQ(scene.meshes.size(), 3U);
    EXPECT_EQ(scene.meshes[1].positions,
              (Vertices{{0, 0, 0}, {1, 0, 0}, {2, 2, -1}, {0, 0, 0}, {2, 2, -1}, {0, 1, 0}}));
}

TEST(Gltf, ASparseAccessorWithoutABaseStartsFromZeros) {
    GltfBuilder b;
    const std::vector<uint8_t> indices{1, 2};
    const std::vector<float> values{3, 0, 0, 0, 4, 0};
    const int positions =
        b.add("accessors", {{"componentType", floatType},
                            {"count", 3},
                            {"type", "VEC3"},
                            {"sparse",
                             {{"count", 2},
                              {"indices", {{"bufferView", b.addView(indices.data(), 2)}, {"componentType", ubyteType}}},
                              {"values", {{"bufferView", b.addView(values.data(), 24)}}}}}});
    b.addPrimitive({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(meshOf(std::move(b)).positions, (Vertices{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}));
}

TEST(Gltf, SparseIndicesReplaceIndices) {
    GltfBuilder b;
    const std::vector<uint16_t> at{1};
    const std::vector<uint8_t> value{2};
    const int positions = b.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const int normals = b.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int indices = b.addAccessor<uint8_t>({0, 1, 1}, "SCALAR", ubyteType);
    b.document["accessors"][static_cast<size_t>(indices)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", b.addView(at.data(), 2)}, {"componentType", ushortType}}},
        {"values", {{"bufferView", b.addView(value.data(), 1)}}}};
    b.addPrimitive({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}});
    EXPECT_EQ(meshOf(std::move(b)).indices, (Indices{0, 2, 1}));
}

template <class T>
VertexAttributes firstVertex(const char* semantic, const char* type, int componentType, bool normalized,
                             std::vector<T> components) {
    GltfBuilder b;
    const size_t size = GltfBuilder::componentsOf(type);
    components.resize(size, T{});
    std::vector<T> all;
    for (int v = 0; v < 3; ++v) {
        all.insert(all.end(), components.begin(), components.end());
    }
    const int positions = b.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    json attributes = {{"POSITION", positions}, {"NORMAL", b.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}};
    const int accessor = b.addAccessor(all, type, componentType);
    b.document["accessors"][static_cast<size_t>(accessor)]["normalized"] = normalized;
    attributes[semantic] = accessor;
    b.addPrimitive({{"attributes", attributes}});
    return meshOf(std::move(b)).attributes.at(0);
}

TEST(Gltf, QuantisedPositionsAreReadAsTheyAreOrNormalised) {
    const auto positions = [](auto components, int type, bool normalized) {
        GltfBuilder b;
        const size_t size = sizeof(components[0]);
        const int stride = size == 1 ? 4 : 8;  // three components, padded to a multiple of four bytes
        std::vector<uint8_t> bytes(3 * static_cast<size_t>(stride), 0);
        std::memcpy(bytes.data(), components.data(), 3 * size);
        const int view = b.addView(bytes.data(), bytes.size(), stride);
        b.addPrimitive({{"attributes",
                         {{"POSITION", b.add("accessors", {{"bufferView", view},
                                                           {"componentType", type},
                                                           {"normalized", normalized},
                                                           {"count", 3},
                                                           {"type", "VEC3"}})}}}});
        return meshOf(std::move(b)).positions[0];
    };
    EXPECT_EQ(positions(std::vector<int8_t>{-128, 127, 5}, byteType, false), vec3(-128, 127, 5));
    EXPECT_EQ(positions(std::vector<int8_t>{-128, 127, 0}, byteType, true), vec3(-1, 1, 0));
    EXPECT_EQ(positions(std::vector<uint8_t>{255, 51, 0}, ubyteType, true), vec3(1, 0.2F, 0));
    EXPECT_EQ(positions(std::vector<int16_t>{-32768, 32767, -7}, shortType, false), vec3(-32768, 32767, -7));
    EXPECT_EQ(positions(std::vector<int16_t>{-32768, -32767, 32767}, shortType, true), vec3(-1, -1, 1));
    EXPECT_EQ(positions(std::vector<uint16_t>{65535, 13107, 0}, ushortType, true), vec3(1, 0.2F, 0));
}

TEST(Gltf, QuantisedNormalsTangentsAndTexcoordsAreRead) {
    EXPECT_EQ(firstVertex<int16_t>("TANGENT", "VEC4", shortType, true, {0, 32767, 0, -32767}).tangent,
              vec4(0, 1, 0, -1));
    EXPECT_EQ(firstVertex<int8_t>("TANGENT", "VEC4", byteType, true, {0, -127, 0, 127}).tangent, vec4(0, -1, 0, 1));
    EXPECT_EQ(firstVertex<uint16_t>("TEXCOORD_0", "VEC2", ushortType, true, {65535, 13107}).uv0, vec2(1, 0.2F));
    EXPECT_EQ(firstVertex<int16_t>("TEXCOORD_0", "VEC2", shortType, false, {-3, 700}).uv0, vec2(-3, 700));
    EXPECT_EQ(firstVertex<float>("TEXCOORD_1", "VEC2", floatType, false, {0.25F, -2.0F}).uv1, vec2(0.25F, -2.0F));
    EXPECT_EQ(firstVertex<float>("NORMAL", "VEC3", floatType, false, {0, 5, 0}).normal, vec3(0, 1, 0));
}

TEST(Gltf, VertexColorsMayBeFloatsBytesOrShortsWithAlphaOrWithout) {
    using Color = glm::u16vec4;
    EXPECT_EQ(firstVertex<float>("COLOR_0", "VEC3", floatType, false, {1, 0.5F, 7}).color,
              Color(65535, 32768, 65535, 65535));
    EXPECT_EQ(firstVertex<float>("COLOR_0", "VEC4", floatType, false, {0, -1, 1, 0}).color, Color(0, 0, 65535, 0));
    EXPECT_EQ(firstVertex<uint8_t>("COLOR_0", "VEC4", ubyteType, true, {255, 51, 0, 1}).color,
              Color(65535, 13107, 0, 257));
    EXPECT_EQ(firstVertex<uint16_t>("COLOR_0", "VEC4", ushortType, true, {65535, 1, 2, 3}).color,
              Color(65535, 1, 2, 3));
    EXPECT_EQ(firstVertex<uint8_t>("COLOR_0", "VEC4", ubyteType, false, {255, 51, 0, 1}).color,
              Color(65535, 13107, 0, 257));
}

TEST(Gltf, AByteStrideInterleavesAttributes) {
    GltfBuilder b;
    const std::vector<float> interleaved{0, 0, 0, 0, 0, 2, 1, 0, 0, 0, 0, 2, 0, 1, 0, 0, 0, 2};
    const int view = b.addView(interleaved.data(), interleaved.size() * 4, 24);
    const auto accessor = [&](int offset) {
        return b.add("accessors", {{"bufferView", view},
                                   {"byteOffset", offset},
                                   {"componentType", floatType},
                                   {"count", 3},
                                   {"type", "VEC3"}});
    };
    const int positions = accessor(0);
    b.addPrimitive({{"attributes", {{"POSITION", positions}, {"NORMAL", accessor(12)}}}});
    const Mesh mesh = meshOf(std::move(b));
    EXPECT_EQ(mesh.positions, (Vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.attributes[2].normal, vec3(0, 0, 1));
}

TEST(Gltf, APrimitiveWithoutPositionsIsLeftOutWithAWarning) {
    GltfBuilder b = triangle();
    b.document["meshes"][0]["primitives"].push_back({{"attributes", json::object()}});
    const Loaded loaded = load(std::move(b));
    EXPECT_EQ(loaded.scene.meshes.size(), 1U);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(
        loaded.warnings[0].find("meshes[0].primitives[1].attributes: the primitive will not be drawn: has no POSITION"),
        std::string::npos);
}

}  // namespace
}  // namespace reflet::test::gltf_test
