// Decodes primitives compressed with KHR_draco_mesh_compression; the packaged tinygltf is built without Draco. The
// counts in the headers are checked before the Draco library allocates memory for them. Layout of the headers: "Draco
// 3D Data Compression Bitstream Specification", version 2.2, 2018.
#include "scene/gltf/draco.h"

#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/metadata/metadata_decoder.h>

#include <algorithm>
#include <functional>
#include <span>

namespace reflet {

namespace {

constexpr uint8_t encoderMesh = 1;
constexpr uint8_t methodEdgebreaker = 1;
constexpr uint16_t flagMetadata = 0x8000;
constexpr uint64_t maxFacesPerByte = 4096;  // far beyond real meshes
constexpr uint64_t decoderBytesPerFace = 128;
constexpr int mostComponents = 16;  // of an attribute; glTF's have four at most
constexpr int bytesOfInteger = 4;   // that each component is decoded to before it has its own type

/// LEB128, as Draco writes counts.
bool readVarint(draco::DecoderBuffer& buffer, uint64_t& value) {
    value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
        uint8_t byte = 0;
        if (!buffer.Decode(&byte)) {
            return false;
        }
        value |= uint64_t(byte & 0x7FU) << shift;
        if ((byte & 0x80U) == 0) {
            return true;
        }
    }
    return false;
}

/// Draco's decoder of meshes of one kind. `check` is called with the mesh when all its attributes are described, and
/// before memory is taken for their values; what it throws leaves decode().
template <class Decoder>
class CheckedDecoder : public Decoder {
public:
    explicit CheckedDecoder(std::function<void(const draco::PointCloud&)> check) : check_(std::move(check)) {}

protected:
    bool DecodeAllAttributes() override {
        check_(*this->point_cloud());
        return Decoder::DecodeAllAttributes();
    }

private:
    std::function<void(const draco::PointCloud&)> check_;
};

/// The memory that the values of all attributes take. Throws Error if one is wider than glTF could need.
uint64_t bytesOfAttributes(const draco::PointCloud& mesh, const std::string& part, const GltfReport& report) {
    uint64_t bytes = 0;
    for (int i = 0; i < mesh.num_attributes(); ++i) {
        const draco::PointAttribute& attribute = *mesh.attribute(i);
        const int components = attribute.num_components();
        if (components > mostComponents) {
            report.fail(part, "its Draco data has an attribute of {} components", components);
        }
        bytes += static_cast<uint64_t>(components) *
                 static_cast<uint64_t>(std::max(draco::DataTypeLength(attribute.data_type()), 0) + bytesOfInteger);
    }
    return bytes * mesh.num_points();
}

/// Of the headers.
struct Claims {
    bool edgebreaker = false;
    uint64_t faces = 0;
    uint64_t vertices = 0;
};

/// False if a header is broken.
bool readClaims(draco::DecoderBuffer buffer, Claims& claims, const std::string& part, const GltfReport& report) {
    draco::DracoHeader header{};
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) {
        return false;
    }
    if (header.version_major != 2 || header.version_minor != 2) {
        report.fail(part, "is Draco bitstream {}.{}, but only 2.2 is supported", header.version_major,
                    header.version_minor);
    }
    if (header.encoder_type != encoderMesh) {
        report.fail(part, "is a Draco point cloud, not a mesh");
    }
    if ((header.flags & flagMetadata) != 0) {
        draco::GeometryMetadata metadata;
        if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) {
            return false;
        }
    }
    claims.edgebreaker = header.encoder_method == methodEdgebreaker;
    if (claims.edgebreaker) {
        uint8_t traversal = 0;
        return buffer.Decode(&traversal) && readVarint(buffer, claims.vertices) && readVarint(buffer, claims.faces);
    }
    return readVarint(buffer, claims.faces) && readVarint(buffer, claims.vertices);
}

std::unique_ptr<draco::Mesh> decodeMesh(std::span<const uint8_t> bytes, const std::string& part, GltfReport& report) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    Claims claims;
    if (!readClaims(buffer, claims, part, report)) {
        report.fail(part, "its Draco header is broken");
    }
    if (claims.faces > maxFacesPerByte * bytes.size() || claims.vertices > 3 * claims.faces) {
        report.fail(part, "claims {} triangles and {} vertices in only {} bytes of Draco data", claims.faces,
                    claims.vertices, bytes.size());
    }
    report.charge(part, claims.faces * decoderBytesPerFace + bytes.size());
    const auto check = [&](const draco::PointCloud& cloud) {
        report.charge(part, bytesOfAttributes(cloud, part, report));
    };
    auto mesh = std::make_unique<draco::Mesh>();
    const draco::DecoderOptions options;
    const draco::Status decoded =
        claims.edgebreaker ? CheckedDecoder<draco::MeshEdgebreakerDecoder>(check).Decode(options, &buffer, mesh.get())
                           : CheckedDecoder<draco::MeshSequentialDecoder>(check).Decode(options, &buffer, mesh.get());
    if (!decoded.ok()) {
        report.fail(part, "its Draco data is broken: {}", decoded.error_msg_string());
    }
    return mesh;
}

/// Divisor of a normalized integer.
double scaleOf(draco::DataType type) {
    switch (type) {
        case draco::DT_INT8:
            return 127.0;
        case draco::DT_UINT8:
            return 255.0;
        case draco::DT_INT16:
            return 32767.0;
        case draco::DT_UINT16:
            return 65535.0;
        case draco::DT_INT32:
            return 2147483647.0;
        case draco::DT_UINT32:
            return 4294967295.0;
        default:
            return 1.0;
    }
}

/// One value as up to four floats. The accessor, not Draco, decides whether integers are normalized.
bool convert(const draco::PointAttribute& attribute, draco::AttributeValueIndex index, bool normalized, vec4& value) {
    const auto components = static_cast<int8_t>(std::min<int>(attribute.num_components(), 4));
    if (attribute.data_type() == draco::DT_FLOAT32 || attribute.data_type() == draco::DT_FLOAT64) {
        return attribute.ConvertValue<float>(index, components, &value.x);
    }
    if (attribute.data_type() == draco::DT_BOOL) {  // glTF has none, and any byte may stand for one
        return false;
    }
    std::array<int64_t, 4> integers{};
    if (!attribute.ConvertValue<int64_t>(index, components, integers.data())) {
        return false;
    }
    const double scale = normalized ? scaleOf(attribute.data_type()) : 1.0;
    for (int c = 0; c < components; ++c) {
        const double number = static_cast<double>(integers.at(static_cast<size_t>(c))) / scale;
        value[c] = static_cast<float>(normalized ? std::max(number, -1.0) : number);
    }
    return true;
}

std::vector<vec4> readAttribute(const draco::Mesh& mesh, uint32_t id, bool normalized, int components,
                                const std::string& part, GltfReport& report) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
    if (attribute == nullptr) {
        report.fail(part, "is Draco attribute {}, which the data does not have", id);
    }
    if (attribute->num_components() != components) {
        report.fail(part, "has {} components in Draco, but its accessor has {}", attribute->num_components(),
                    components);
    }
    const uint32_t count = mesh.num_points();
    if (!attribute->is_mapping_identity() && attribute->indices_map_size() < count) {
        report.fail(part, "its Draco data has too few values");
    }
    report.charge(part, uint64_t(count) * sizeof(vec4));
    std::vector<vec4> values(count, vec4(0.0F));
    for (uint32_t i = 0; i < count; ++i) {
        const auto index = attribute->mapped_index(draco::PointIndex(i));
        if (index.value() >= attribute->size() || !convert(*attribute, index, normalized, values[i])) {
            report.fail(part, "its Draco data has no value for vertex {}", i);
        }
    }
    return values;
}

std::vector<uint32_t> readDracoIndices(const draco::Mesh& mesh, const std::string& part, GltfReport& report) {
    report.charge(part, uint64_t(mesh.num_faces()) * 3 * sizeof(uint32_t));
    std::vector<uint32_t> indices;
    indices.reserve(size_t(mesh.num_faces()) * 3);
    for (uint32_t f = 0; f < mesh.num_faces(); ++f) {
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(f))) {
            if (point.value() >= mesh.num_points()) {
                report.fail(part, "its Draco data has an index past its {} vertices", mesh.num_points());
            }
            indices.push_back(point.value());
        }
    }
    return indices;
}

}  // namespace

DracoPrimitive decodeDraco(const GltfDocument& document, const tinygltf::Primitive& primitive, const std::string& part,
                           GltfReport& report) {
    const auto& model = document.model;
    const tinygltf::Value& extension = primitive.extensions.at("KHR_draco_mesh_compression");
    const std::string here = part + ".extensions.KHR_draco_mesh_compression";
    const auto viewIndex = static_cast<size_t>(extension.Get("bufferView").GetNumberAsInt());
    report.use("bufferViews", viewIndex);
    const auto& view = model.bufferViews[viewIndex];
    const std::span bytes(model.buffers[static_cast<size_t>(view.buffer)].data);
    const auto mesh = decodeMesh(bytes.subspan(view.byteOffset, view.byteLength), here, report);

    DracoPrimitive result;
    result.indices = readDracoIndices(*mesh, here, report);
    result.vertices = mesh->num_points();
    for (const std::string& name : extension.Get("attributes").Keys()) {
        const std::string attributePart = fmt::format("{}.attributes.{}", here, name);
        const auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end()) {
            report.fail(attributePart, "is not an attribute of the primitive");
        }
        const auto& accessor = model.accessors[static_cast<size_t>(found->second)];
        const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
        const auto id = static_cast<uint32_t>(extension.Get("attributes").Get(name).GetNumberAsInt());
        auto& values = result.values[name];
        const bool normalized = accessor.normalized || name == "COLOR_0";  // integer colours are always normalized
        values = readAttribute(*mesh, id, normalized, components, attributePart, report);
        result.attributes[name] = {.data = reinterpret_cast<const uint8_t*>(values.data()),
                                   .stride = sizeof(vec4),
                                   .components = components,
                                   .count = result.vertices};
    }
    return result;
}

}  // namespace reflet
