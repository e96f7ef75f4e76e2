// Gives access to the attributes and triangles of a glTF primitive, whether from accessors or from Draco.
#include "scene/gltf/primitive.h"

#include "scene/gltf/schema_tables.h"

#include <algorithm>
#include <array>
#include <optional>

namespace reflet {

namespace {

struct SemanticRule {
    std::string_view semantic;  ///< with a trailing "_": of each of a set, as TEXCOORD_0, TEXCOORD_1
    int minComponents;
    int maxComponents;
    const char* without;  ///< consequence of leaving it out; null: the primitive cannot be drawn without it
};
constexpr std::array<SemanticRule, 7> semantics{{{"POSITION", 3, 3, nullptr},
                                                 {"NORMAL", 3, 3, "the surface will be faceted"},
                                                 {"TANGENT", 4, 4, "the tangents will be computed"},
                                                 {"TEXCOORD_", 2, 2, "textures will have one colour"},
                                                 {"COLOR_0", 3, 4, "vertex colours will be missing"},
                                                 {"JOINTS_", 4, 4, "the mesh will not be deformed"},
                                                 {"WEIGHTS_", 4, 4, "the mesh will not be deformed"}}};

constexpr uint32_t noVertex = 0xFFFFFFFF;  // greater than any index

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
        (rule.semantic.starts_with("JOINTS_") && !isJoint)) {
        report.fail(fmt::format("accessors[{}].componentType", index), "is {}, which is not allowed for {}",
                    accessor.componentType, rule.semantic);
    }
}

/// `expected`: the number of vertices.
AccessorView openAttribute(const GltfDocument& document, const SemanticRule& rule, int accessor,
                           const DracoPrimitive& draco, std::optional<uint32_t> expected, const std::string& part,
                           GltfReport& report) {
    report.use("accessors", static_cast<size_t>(accessor));
    checkType(document.model.accessors[static_cast<size_t>(accessor)], rule, accessor, report);
    const auto decoded = draco.attributes.find(std::string(rule.semantic));
    AccessorView view = decoded != draco.attributes.end() ? decoded->second : viewAccessor(document, accessor, report);
    if (view.count != expected.value_or(view.count)) {
        report.fail(fmt::format("{}.attributes.{}", part, rule.semantic), "has {} vertices, but POSITION has {}",
                    view.count, *expected);
    }
    return view;
}

std::map<std::string, AccessorView> openAttributes(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                                   const DracoPrimitive& draco, const std::string& part,
                                                   GltfReport& report) {
    std::map<std::string, AccessorView> result;
    const auto openAs = [&](const SemanticRule& rule, int accessor) {
        const auto positions = result.find("POSITION");  // the first of the semantics
        const auto expected = positions != result.end() ? std::optional(positions->second.count) : std::nullopt;
        const auto open = [&] {
            result.insert_or_assign(std::string(rule.semantic),
                                    openAttribute(document, rule, accessor, draco, expected, part, report));
        };
        if (rule.without == nullptr) {
            open();
        } else {
            report.tolerate(rule.without, open);
        }
    };
    for (const SemanticRule& rule : semantics) {
        for (const auto& [name, accessor] : primitive.attributes) {
            if (name == rule.semantic || gltf_schema::attributeSet(name, rule.semantic) >= 0) {
                SemanticRule named = rule;
                named.semantic = name;
                openAs(named, accessor);
            }
        }
    }
    return result;
}

/// Indices that are invalid are noVertex.
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
    uint32_t firstInvalid = view.count;
    for (uint32_t i = 0; i < view.count; ++i) {
        indices[i] = view.integerAt(i);
        if (indices[i] == restart || indices[i] >= vertices) {
            firstInvalid = std::min(firstInvalid, i);
            indices[i] = noVertex;
        }
    }
    report.tolerate("triangles will be missing", [&] {
        if (firstInvalid < view.count) {
            const uint32_t invalid = view.integerAt(firstInvalid);
            if (invalid == restart) {
                report.fail(part, "index {} is {}, the primitive restart value, which glTF does not allow",
                            firstInvalid, invalid);
            }
            report.fail(part, "index {} is {}, but there are {} vertices", firstInvalid, invalid, vertices);
        }
    });
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
    const auto check = [&] {
        if (count < 3 || (list && count % 3 != 0)) {
            report.fail(part, "{} {} do not make whole triangles", count, indices != nullptr ? "indices" : "vertices");
        }
    };
    if (count < 3) {
        check();
    }
    report.tolerate("the incomplete triangle will be missing", check);
    const uint32_t triangles = list ? count / 3 : count - 2;
    report.charge(part, uint64_t(triangles) * 3 * sizeof(uint32_t));
    std::vector<uint32_t> result;
    result.reserve(size_t(triangles) * 3);
    for (uint32_t t = 0; t < triangles; ++t) {
        std::array<uint32_t, 3> triangle = corners(mode, t);
        for (uint32_t& corner : triangle) {
            corner = indices != nullptr ? (*indices)[corner] : corner;
        }
        // One with a repeated vertex has no area. Strips are joined by them, and an accessor without data is made of
        // them.
        const bool hasArea = triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
        if (hasArea && std::ranges::find(triangle, noVertex) == triangle.end()) {
            result.insert(result.end(), triangle.begin(), triangle.end());
        }
    }
    if (result.empty()) {
        report.fail(part, "has no triangle with three different valid indices");
    }
    return result;
}

/// Points, or the two ends of each segment. Without `indices`: the vertices in order.
std::vector<uint32_t> makeThinElements(int mode, const std::vector<uint32_t>* indices, uint32_t vertices,
                                       const std::string& part, GltfReport& report) {
    const uint32_t count = indices != nullptr ? static_cast<uint32_t>(indices->size()) : vertices;
    report.charge(part, uint64_t(count) * 2 * sizeof(uint32_t));
    const auto at = [&](uint32_t i) { return indices != nullptr ? (*indices)[i] : i; };
    std::vector<uint32_t> result;
    const auto addLine = [&](uint32_t a, uint32_t b) {
        if (at(a) != noVertex && at(b) != noVertex && at(a) != at(b)) {
            result.insert(result.end(), {at(a), at(b)});
        }
    };
    const uint32_t step = mode == TINYGLTF_MODE_LINE ? 2 : 1;
    for (uint32_t i = 0; mode == TINYGLTF_MODE_POINTS && i < count; ++i) {
        if (at(i) != noVertex && (i == 0 || at(i) != at(i - 1))) {
            result.push_back(at(i));
        }
    }
    for (uint32_t i = 0; mode != TINYGLTF_MODE_POINTS && i + 1 < count; i += step) {
        addLine(i, i + 1);
    }
    if (mode == TINYGLTF_MODE_LINE_LOOP && count > 2) {
        addLine(count - 1, 0);
    }
    if (result.empty()) {
        report.fail(part, "{} {} make no {}", count, indices != nullptr ? "indices" : "vertices",
                    mode == TINYGLTF_MODE_POINTS ? "point" : "line");
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
        if (vertices != source.draco.vertices) {  // positions that are not compressed
            report.fail(part + ".attributes.POSITION", "has {} vertices, but the Draco data has {}", vertices,
                        source.draco.vertices);
        }
        source.triangles = std::move(source.draco.indices);
    } else {
        std::vector<uint32_t> indices;
        if (primitive.indices >= 0) {
            indices = readIndices(document, primitive.indices, vertices, report);
        }
        const std::vector<uint32_t>* listed = primitive.indices >= 0 ? &indices : nullptr;
        const bool thin = primitive.mode < TINYGLTF_MODE_TRIANGLES;
        source.corners = !thin ? 3 : primitive.mode == TINYGLTF_MODE_POINTS ? 1 : 2;
        source.triangles = thin ? makeThinElements(primitive.mode, listed, vertices, part, report)
                                : makeTriangles(primitive.mode, listed, vertices, part, report);
    }
    return source;
}

}  // namespace reflet
