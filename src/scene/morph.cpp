// Morph targets at given weights.
#include "scene/morph.h"

#include "scene/gltf/normals.h"

#include <span>

namespace reflet {

namespace {

std::span<const MorphDelta> deltasOf(const Mesh& mesh, size_t vertex, const std::vector<float>& weights) {
    if (weights.empty() || mesh.morph.vertices.empty()) {
        return {};
    }
    const Morph::Range& range = mesh.morph.vertices[vertex];
    return std::span(mesh.morph.deltas).subspan(range.first, range.count);
}

}  // namespace

vec3 morphedPosition(const Mesh& mesh, size_t vertex, const std::vector<float>& weights) {
    const vec3& base = mesh.positions[vertex];
    vec3 position = base;
    for (const MorphDelta& delta : deltasOf(mesh, vertex, weights)) {
        position += weights[delta.target] * delta.position;
    }
    return isFinite(vec4(position, 1.0F)) ? position : base;
}

Mesh morphed(const Mesh& mesh, const std::vector<float>& weights) {
    Mesh result = mesh;
    result.morph = {};
    result.bounds = {};
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const VertexAttributes& base = mesh.attributes[i];
        vec3 normal = base.normal;
        vec3 tangent(base.tangent);
        for (const MorphDelta& delta : deltasOf(mesh, i, weights)) {
            normal += weights[delta.target] * delta.normal;
            tangent += weights[delta.target] * delta.tangent;
        }
        result.positions[i] = morphedPosition(mesh, i, weights);
        result.bounds.add(result.positions[i]);
        result.attributes[i].normal = unitOr(normal, base.normal);
        result.attributes[i].tangent = vec4(unitOr(tangent, vec3(base.tangent)), base.tangent.w);
    }
    return result;
}

Aabb morphedBounds(const Mesh& mesh, const Aabb& box, const std::vector<float>& weights) {
    Aabb result = box;
    for (size_t t = 0; t < weights.size() && t < mesh.morph.targets.size(); ++t) {
        const vec3 a = weights[t] * mesh.morph.targets[t].min;
        const vec3 b = weights[t] * mesh.morph.targets[t].max;
        result.min += glm::min(a, b);
        result.max += glm::max(a, b);
    }
    return isFinite(vec4(result.min, 1.0F)) && isFinite(vec4(result.max, 1.0F)) ? result : box;
}

}  // namespace reflet
