// Loading of glTF primitives compressed with Draco.
#include "base/error.h"
#include "gltf_builder.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

namespace reflet::test::gltf_draco_test {
namespace {

using nlohmann::json;

TEST(GltfDraco, ADracoMeshHasTheTrianglesAndNormalsThatWereEncoded) {
    const Scene scene = load(everything()).scene;
    const Mesh& mesh = scene.meshes.at(2);
    ASSERT_EQ(mesh.indices.size(), 6U);
    ASSERT_EQ(mesh.positions.size(), 4U);
    float area = 0.0F;
    for (size_t t = 0; t < 2; ++t) {
        const vec3& a = mesh.positions[mesh.indices[3 * t]];
        const vec3& b = mesh.positions[mesh.indices[3 * t + 1]];
        const vec3& c = mesh.positions[mesh.indices[3 * t + 2]];
        area += 0.5F * glm::cross(b - a, c - a).z;  // positive where it faces +Z
    }
    EXPECT_EQ(area, 1.0F);
    EXPECT_EQ(mesh.bounds.min, vec3(0, 0, 0));
    EXPECT_EQ(mesh.bounds.max, vec3(1, 1, 0));
    for (const VertexAttributes& vertex : mesh.attributes) {
        EXPECT_EQ(vertex.normal, vec3(0, 0, 1));
    }
}

/// One triangle with attributes of any type; all vertices have the same value, except for positions.
class DracoTriangle {
public:
    DracoTriangle() {
        soup_.Start(1);
        const std::array<int16_t, 9> corners{0, 0, 0, 300, 0, 0, 0, -20, 0};
        const int id = soup_.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_INT16);
        soup_.SetAttributeValuesForFace(id, draco::FaceIndex(0), corners.data(), &corners[3], &corners[6]);
        describe("POSITION", shortType, "VEC3", false);
    }

    template <class T>
    void add(const char* semantic, draco::DataType type, int componentType, bool normalized, std::vector<T> value) {
        const auto size = static_cast<int8_t>(value.size());
        const int id = soup_.AddAttribute(draco::GeometryAttribute::GENERIC, size, type);
        soup_.SetAttributeValuesForFace(id, draco::FaceIndex(0), value.data(), value.data(), value.data());
        describe(semantic, componentType, "VEC" + std::to_string(value.size()), normalized);
    }

    /// Positions are those of an accessor, zeros, and not in the Draco data.
    void leavePositionsOut(uint32_t count) {
        ids_.erase("POSITION");
        builder_.document["accessors"][accessors_["POSITION"].get<size_t>()]["count"] = count;
    }

    /// One that no accessor has.
    void addUnused(int8_t components) {
        const std::vector<float> value(static_cast<size_t>(components), 1.0F);
        const int id = soup_.AddAttribute(draco::GeometryAttribute::GENERIC, components, draco::DT_FLOAT32);
        soup_.SetAttributeValuesForFace(id, draco::FaceIndex(0), value.data(), value.data(), value.data());
    }

    Mesh load(int method) {
        auto metadata = std::make_unique<draco::GeometryMetadata>();
        metadata->AddEntryString("made by", "a test");
        soup_.AddMetadata(std::move(metadata));
        const auto mesh = soup_.Finalize();
        draco::Encoder encoder;
        draco::EncoderBuffer buffer;
        encoder.SetEncodingMethod(method);
        EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
        const json extension = {{"bufferView", builder_.addView(buffer.data(), buffer.size())}, {"attributes", ids_}};
        builder_.addPrimitive(
            {{"attributes", accessors_}, {"extensions", {{"KHR_draco_mesh_compression", extension}}}});
        return test::load(builder_).scene.meshes.at(0);
    }

private:
    void describe(const std::string& semantic, int componentType, const std::string& type, bool normalized) {
        ids_[semantic] = ids_.size();
        accessors_[semantic] = builder_.add(
            "accessors", {{"componentType", componentType}, {"type", type}, {"count", 3}, {"normalized", normalized}});
    }

    draco::TriangleSoupMeshBuilder soup_;
    GltfBuilder builder_;
    json ids_ = json::object();
    json accessors_ = json::object();
};

TEST(GltfDraco, AttributesMayHaveAnyTypeAndTheAccessorSaysWhetherTheyAreNormalised) {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        DracoTriangle triangle;
        triangle.add<int8_t>("NORMAL", draco::DT_INT8, byteType, true, {0, 0, -127});
        triangle.add<float>("TANGENT", draco::DT_FLOAT32, floatType, false, {0, 2, 0, -1});
        triangle.add<uint16_t>("TEXCOORD_0", draco::DT_UINT16, ushortType, true, {65535, 13107});
        triangle.add<int16_t>("TEXCOORD_1", draco::DT_INT16, shortType, false, {-3, 700});
        triangle.add<uint8_t>("COLOR_0", draco::DT_UINT8, ubyteType, false, {255, 51, 0, 1});
        const Mesh mesh = triangle.load(method);
        ASSERT_EQ(mesh.indices.size(), 3U);
        EXPECT_EQ(mesh.bounds.min, vec3(0, -20, 0));
        EXPECT_EQ(mesh.bounds.max, vec3(300, 0, 0));
        for (const VertexAttributes& vertex : mesh.attributes) {
            EXPECT_EQ(vertex.normal, vec3(0, 0, -1));
            EXPECT_EQ(vertex.tangent, vec4(0, 1, 0, -1));
            EXPECT_EQ(vertex.uv0, vec2(1, 0.2F));
            EXPECT_EQ(vertex.uv1, vec2(-3, 700));
            EXPECT_EQ(vertex.color, glm::u16vec4(65535, 13107, 0, 257));
        }
    }
}

TEST(GltfDraco, AnAttributeOfTruthValuesIsAnError) {
    DracoTriangle triangle;
    triangle.add<uint8_t>("COLOR_0", draco::DT_BOOL, ubyteType, false, {212, 1, 0, 1});
    EXPECT_THROW(triangle.load(draco::MESH_SEQUENTIAL_ENCODING), Error);
}

// Two megabytes of it could claim four gigabytes of values, also in attributes that nothing uses.
TEST(GltfDraco, AttributesAreOfSixteenComponentsAtMost) {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        DracoTriangle wide;
        wide.addUnused(16);
        EXPECT_EQ(wide.load(method).indices.size(), 3U);
        DracoTriangle wider;
        wider.addUnused(17);
        try {
            wider.load(method);
            ADD_FAILURE() << method;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("has an attribute of 17 components"), std::string::npos)
                << error.what();
        }
    }
}

TEST(GltfDraco, PositionsThatAreNotCompressedAreAsManyAsTheDataHasVertices) {
    for (const uint32_t count : {2U, 3U, 4U}) {
        DracoTriangle triangle;
        triangle.add<int8_t>("NORMAL", draco::DT_INT8, byteType, true, {0, 0, -127});
        triangle.leavePositionsOut(count);
        if (count == 3) {
            EXPECT_EQ(triangle.load(draco::MESH_SEQUENTIAL_ENCODING).positions, std::vector<vec3>(3, vec3(0)));
        } else {
            EXPECT_THROW(triangle.load(draco::MESH_SEQUENTIAL_ENCODING), Error) << count;
        }
    }
}

}  // namespace
}  // namespace reflet::test::gltf_draco_test
