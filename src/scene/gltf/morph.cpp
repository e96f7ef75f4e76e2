// Reads morph targets of glTF primitives and their weights.
#include "scene/gltf/morph.h"

#include "scene/gltf/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace reflet {

namespace {

/// The accessors of one morph target, by what they displace; null: nothing.
struct TargetViews {
    std::optional<AccessorView> position;
    std::optional<AccessorView> normal;
    std::optional<AccessorView> tangent;
};

std::optional<AccessorView> openTarget(const GltfDocument& document, const std::map<std::string, int>& target,
                                       const char* semantic, uint32_t vertices, const std::string& part,
                                       GltfReport& report) {
    const auto found = target.find(semantic);
    if (found == target.end()) {
        return std::nullopt;
    }
    const auto& accessor = document.model.accessors[static_cast<size_t>(found->second)];
    if (accessor.type != TINYGLTF_TYPE_VEC3 || accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        report.fail(fmt::format("{}.{}", part, semantic), "is not an accessor of VEC3 floats or small integers");
    }
    const AccessorView view = viewAccessor(document, found->second, report);
    if (view.count != vertices) {
        report.fail(fmt::format("{}.{}", part, semantic), "has {} elements, but POSITION has {}", view.count, vertices);
    }
    return view;
}

vec3 deltaAt(const std::optional<AccessorView>& view, uint32_t vertex) {
    const vec4 delta = view ? view->at(vertex) : vec4(0.0F);
    return isFinite(delta) ? vec3(delta) : vec3(0.0F);
}

/// The normal of a triangle whose corners are moved by the target; `otherwise` if it has none.
vec3 flatNormal(const std::array<vec3, 3>& corners, const vec3& otherwise) {
    const glm::dvec3 a(corners[0]);
    const glm::dvec3 across = glm::cross(glm::dvec3(corners[1]) - a, glm::dvec3(corners[2]) - a);
    const double length = glm::length(across);
    return length > 0.0 && std::isfinite(length) ? vec3(across / length) : otherwise;
}

/// The deltas of a triangle, which the flat normals of `makeFlat` gave its own three vertices from `first` on.
void addFlatTriangle(const Mesh& mesh, size_t first, Morph& flat) {
    std::vector<uint32_t> targets;
    for (size_t c = 0; c < 3; ++c) {
        const Morph::Range& range = mesh.morph.vertices[first + c];
        for (uint32_t d = range.first; d < range.first + range.count; ++d) {
            targets.push_back(mesh.morph.deltas[d].target);
        }
    }
    std::ranges::sort(targets);
    targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
    std::array<std::vector<MorphDelta>, 3> deltas;
    std::array<uint32_t, 3> next{};  // of each corner's deltas, which are in the order of their targets
    for (const uint32_t target : targets) {
        std::array<vec3, 3> moved{};
        for (size_t c = 0; c < 3; ++c) {
            const Morph::Range& range = mesh.morph.vertices[first + c];
            MorphDelta& delta = deltas.at(c).emplace_back(MorphDelta{.target = target});
            const uint32_t d = range.first + next.at(c);
            if (next.at(c) < range.count && mesh.morph.deltas[d].target == target) {
                delta.position = mesh.morph.deltas[d].position;
                ++next.at(c);
            }
            moved.at(c) = mesh.positions[first + c] + delta.position;
        }
        const vec3& base = mesh.attributes[first].normal;
        const vec3 normal = flatNormal(moved, base) - base;
        for (auto& corner : deltas) {
            corner.back().normal = normal;
        }
    }
    for (const auto& corner : deltas) {
        flat.vertices.push_back({static_cast<uint32_t>(flat.deltas.size()), static_cast<uint32_t>(corner.size())});
        flat.deltas.insert(flat.deltas.end(), corner.begin(), corner.end());
    }
}

}  // namespace

void readGltfMorph(Mesh& mesh, const GltfDocument& document, const tinygltf::Primitive& source,
                   const PrimitiveSource& opened, const std::vector<uint32_t>& used, const std::string& part,
                   GltfReport& report) {
    if (source.targets.empty()) {
        return;
    }
    // glTF 2.0, 3.7.2.2: without normals or tangents of the mesh, those of its targets are ignored.
    const bool normals = opened.find("NORMAL") != nullptr;
    const bool tangents = normals && opened.find("TANGENT") != nullptr;
    const uint32_t vertices = opened.find("POSITION")->count;
    std::vector<TargetViews> targets;
    for (size_t t = 0; t < source.targets.size(); ++t) {
        const std::string here = fmt::format("{}.targets[{}]", part, t);
        report.charge(here, used.size() * sizeof(MorphDelta) + sizeof(TargetViews));
        const auto open = [&](const char* semantic) {
            return openTarget(document, source.targets[t], semantic, vertices, here, report);
        };
        targets.push_back(
            {open("POSITION"), normals ? open("NORMAL") : std::nullopt, tangents ? open("TANGENT") : std::nullopt});
    }
    report.charge(part, used.size() * sizeof(Morph::Range));
    mesh.morph.targets.assign(targets.size(), Aabb{vec3(0.0F), vec3(0.0F)});
    for (const uint32_t v : used) {
        const auto first = static_cast<uint32_t>(mesh.morph.deltas.size());
        for (uint32_t t = 0; t < targets.size(); ++t) {
            const MorphDelta delta{t, deltaAt(targets[t].position, v), deltaAt(targets[t].normal, v),
                                   deltaAt(targets[t].tangent, v)};
            if (delta.position != vec3(0.0F) || delta.normal != vec3(0.0F) || delta.tangent != vec3(0.0F)) {
                mesh.morph.deltas.push_back(delta);
                mesh.morph.targets[t].add(delta.position);
            }
        }
        mesh.morph.vertices.push_back({first, static_cast<uint32_t>(mesh.morph.deltas.size()) - first});
    }
}

void makeMorphFlat(Mesh& mesh, const std::string& part, GltfReport& report) {
    if (mesh.morph.vertices.empty()) {
        return;
    }
    uint64_t deltas = 0;
    for (const Morph::Range& range : mesh.morph.vertices) {
        deltas += range.count;
    }
    report.charge(part,
                  (3 * deltas + 1) * sizeof(MorphDelta));  // of a corner's targets, its two neighbours may have none
    Morph flat;
    flat.targets = mesh.morph.targets;
    for (size_t first = 0; first + 2 < mesh.positions.size(); first += 3) {
        addFlatTriangle(mesh, first, flat);
    }
    mesh.morph = std::move(flat);
}

size_t gltfMorphTargets(const GltfDocument& document, int mesh, const GltfReport& report) {
    const auto& primitives = document.model.meshes[static_cast<size_t>(mesh)].primitives;
    for (size_t p = 1; p < primitives.size(); ++p) {
        if (primitives[p].targets.size() != primitives[0].targets.size()) {
            report.fail(fmt::format("meshes[{}].primitives[{}].targets", mesh, p),
                        "has {} morph targets, but primitives[0] has {}", primitives[p].targets.size(),
                        primitives[0].targets.size());
        }
    }
    return primitives.empty() ? 0 : primitives[0].targets.size();
}

std::vector<float> gltfMorphWeights(const GltfDocument& document, const tinygltf::Node& node, const std::string& part,
                                    const GltfReport& report) {
    const size_t targets = gltfMorphTargets(document, node.mesh, report);
    if (targets == 0) {
        return {};
    }
    const bool own = !node.weights.empty();
    const auto& weights = own ? node.weights : document.model.meshes[static_cast<size_t>(node.mesh)].weights;
    if (!weights.empty() && weights.size() != targets) {
        report.fail(own ? part + ".weights" : fmt::format("meshes[{}].weights", node.mesh),
                    "has {} weights for {} morph targets", weights.size(), targets);
    }
    std::vector<float> result(weights.begin(), weights.end());
    result.resize(targets, 0.0F);
    return result;
}

}  // namespace reflet
