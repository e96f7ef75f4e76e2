// Gives access to the attributes and triangles of a glTF primitive, whether from accessors or from Draco.
#include "scene/gltf_primitive.h"

#include <array>

namespace reflet {

namespace {

struct SemanticRule {
    const char* semantic;
    int minComponents;
    int maxComponents;
};
constexpr std::array<SemanticRule, 8> semantics{{{"POSITION", 3, 3},
                                                 {"NORMAL", 3, 3},
                                                 {"TANGENT", 4, 4},
                                                 {"TEXCOORD_0", 2, 2},
                                                 {"TEXCOORD_1", 2, 2},
                                                 {"COLOR_0", 3, 4},
                                                 {"JOINTS_0", 4, 4},
                                                 {"WEIGHTS_0", 4, 4}}};

/// The types of glTF 2.0 and KHR_mesh_quantization: all but 32-bit integers, which floats cannot represent.
void checkType(const tinygltf::Accessor& accessor, const SemanticRule& rule, int index, const GltfReport& report) {
    const bool isVector = accessor.type == TINYGLTF_TYPE_VEC2 || accessor.type == TINYGLTF_TYPE_VEC3 ||
                          accessor.type == TINYGLTF_TYPE_VEC4;
    const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    if (!isVector || components < rule.minComponents || components > rule.maxComponents) {
        report.fail(fmt::format("accessors[{}]", index), "has {} components{}, but a {} has {}", components,
                    isVector ? "" : " that are not a vector", rule.semantic, rule.minComponents);
    }
    const bool isJoint = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                         accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT ||
        (std::string_view(rule.semantic) == "JOINTS_0" && !isJoint)) {
        report.fail(fmt::format("accessors[{}].componentType", index), "is {}, which is not allowed for {}",
                    accessor.componentType, rule.semantic);
    }
}

std::map<std::string, AccessorView> openAttributes(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                                   const DracoPrimitive& draco, const std::string& part,
                                                   GltfReport& report) {
    std::map<std::string, AccessorView> result;
    for (const SemanticRule& rule : semantics) {
        const auto found = primitive.attributes.find(rule.semantic);
        if (found == primitive.attributes.end()) {
            continue;
        }
        checkType(document.model.accessors[static_cast<size_t>(found->second)], rule, found->second, report);
        const auto decoded = draco.attributes.find(rule.semantic);
        result[rule.semantic] =
            decoded != draco.attributes.end() ? decoded->second : viewAccessor(document, found->second, report);
        const uint32_t expected = result.at("POSITION").count;  // the first of the semantics
        if (result[rule.semantic].count != expected) {
            report.fail(fmt::format("{}.attributes.{}", part, rule.semantic), "has {} vertices, but POSITION has {}",
                        result[rule.semantic].count, expected);
        }
    }
    return result;
}

std::vector<uint32_t> readIndices(const GltfDocument& document, int index, uint32_t vertices, GltfReport& report) {
    const auto& accessor = document.model.accessors[static_cast<size_t>(index)];
    const std::string part = fmt::format("accessors[{}]", index);
    uint32_t restart = 0xFFFFFFFF;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            restart = 0xFF;
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            restart = 0xFFFF;
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            break;
        default:
            report.fail(part + ".componentType", "is {}, which is not allowed for indices", accessor.componentType);
    }
    if (accessor.type != TINYGLTF_TYPE_SCALAR) {
        report.fail(part + ".type", "is not SCALAR, as indices must be");
    }
    const AccessorView view = viewAccessor(document, index, report);
    report.charge(part, uint64_t(view.count) * sizeof(uint32_t));
    std::vector<uint32_t> indices(view.count);
    for (uint32_t i = 0; i < view.count; ++i) {
        indices[i] = view.integerAt(i);
        if (indices[i] == restart) {
            report.fail(part, "index {} is {}, the primitive restart value, which glTF does not allow", i, restart);
        }
        if (indices[i] >= vertices) {
            report.fail(part, "index {} is {}, but there are {} vertices", i, indices[i], vertices);
        }
    }
    return indices;
}

/// glTF 2.0, 3.7.2.1: the vertices of a triangle in a list, strip or fan.
std::array<uint32_t, 3> corners(int mode, uint32_t triangle) {
    switch (mode) {
        case TINYGLTF_MODE_TRIANGLE_STRIP:
            return {triangle, triangle + 1 + triangle % 2, triangle + 2 - triangle % 2};
        case TINYGLTF_MODE_TRIANGLE_FAN:
            return {triangle + 1, triangle + 2, 0};
        default:
            return {3 * triangle, 3 * triangle + 1, 3 * triangle + 2};
    }
}

/// Without `indices`: the vertices in order.
std::vector<uint32_t> makeTriangles(int mode, const std::vector<uint32_t>* indices, uint32_t vertices,
                                    const std::string& part, GltfReport& report) {
    const uint32_t count = indices != nullptr ? static_cast<uint32_t>(indices->size()) : vertices;
    const bool list = mode == TINYGLTF_MODE_TRIANGLES;
    if (count < 3 || (list && count % 3 != 0)) {
        report.fail(part, "{} {} do not make whole triangles", count, indices != nullptr ? "indices" : "vertices");
    }
    const uint32_t triangles = list ? count / 3 : count - 2;
    report.charge(part, uint64_t(triangles) * 3 * sizeof(uint32_t));
    std::vector<uint32_t> result;
    result.reserve(size_t(triangles) * 3);
    for (uint32_t t = 0; t < triangles; ++t) {
        for (const uint32_t corner : corners(mode, t)) {
            result.push_back(indices != nullptr ? (*indices)[corner] : corner);
        }
    }
    return result;
}

}  // namespace

PrimitiveSource openPrimitive(const GltfDocument& document, const tinygltf::Primitive& primitive,
                              const std::string& part, GltfReport& report) {
    PrimitiveSource source;
    const bool compressed = primitive.extensions.contains("KHR_draco_mesh_compression");
    if (compressed) {
        source.draco = decodeDraco(document, primitive, part, report);
    }
    source.attributes = openAttributes(document, primitive, source.draco, part, report);
    const uint32_t vertices = source.attributes.at("POSITION").count;
    if (compressed) {  // Draco stores triangles, whatever the mode
        if (source.draco.attributes.empty() || source.draco.indices.empty()) {
            report.fail(part + ".extensions.KHR_draco_mesh_compression", "holds no triangles");
        }
        source.triangles = std::move(source.draco.indices);
    } else if (primitive.indices >= 0) {
        const std::vector<uint32_t> indices = readIndices(document, primitive.indices, vertices, report);
        source.triangles = makeTriangles(primitive.mode, &indices, vertices, part, report);
    } else {
        source.triangles = makeTriangles(primitive.mode, nullptr, vertices, part, report);
    }
    return source;
}

}  // namespace reflet
