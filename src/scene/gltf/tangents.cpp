// Tangents for normal maps, for the uvs of their texture. Splits vertices that need several.
#include "scene/gltf/normals.h"

#include "scene/tangent_space.h"

#include <array>
#include <bit>
#include <cstddef>
#include <unordered_map>

namespace reflet {

namespace {

/// A vertex, and a tangent that it has in some triangles.
struct VertexTangent {
    uint32_t vertex;
    std::array<uint32_t, 4> tangent;  ///< the bits

    bool operator==(const VertexTangent&) const = default;
};

struct HashOfVertexTangent {
    size_t operator()(const VertexTangent& of) const {
        uint64_t hash = of.vertex;
        for (const uint32_t word : of.tangent) {
            hash = (hash ^ word) * 0xff51afd7ed558ccdU;
            hash ^= hash >> 32U;
        }
        return hash;
    }
};

std::vector<vec4> tangentsOf(const Mesh& mesh, const TextureSlot& slot) {
    std::vector<vec3> normals;
    std::vector<vec2> uvs;
    normals.reserve(mesh.positions.size());
    uvs.reserve(mesh.positions.size());
    for (const VertexAttributes& vertex : mesh.attributes) {
        const vec3 uv(slot.uvSet == 0 ? vertex.uv0 : vertex.uv1, 1.0F);
        normals.push_back(vertex.normal);
        uvs.emplace_back(glm::dot(glm::dvec3(slot.uvTransform[0]), glm::dvec3(uv)),
                         glm::dot(glm::dvec3(slot.uvTransform[1]), glm::dvec3(uv)));
    }
    return tangentSpaces({mesh.positions, normals, uvs, mesh.indices});
}

uint32_t copyVertex(Mesh& mesh, uint32_t vertex) {
    mesh.positions.push_back(mesh.positions[vertex]);
    mesh.attributes.push_back(mesh.attributes[vertex]);
    if (!mesh.skin.empty()) {
        mesh.skin.push_back(mesh.skin[vertex]);
    }
    if (!mesh.morph.vertices.empty()) {
        mesh.morph.vertices.push_back(mesh.morph.vertices[vertex]);
    }
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

}  // namespace

void makeTangents(Mesh& mesh, const TextureSlot& texture) {
    const std::vector<vec4> tangents = tangentsOf(mesh, texture);
    std::vector<bool> has(mesh.positions.size(), false);
    for (VertexAttributes& vertex : mesh.attributes) {
        vertex.tangent = vec4(perpendicular(vertex.normal), 1.0F);  // of what is in no triangle with a frame
    }
    std::unordered_map<VertexTangent, uint32_t, HashOfVertexTangent> copies;
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t vertex = mesh.indices[i];
        const vec4 tangent(unitOr(vec3(tangents[i]), perpendicular(mesh.attributes[vertex].normal)), tangents[i].w);
        if (tangents[i].w == 0.0F || (has[vertex] && mesh.attributes[vertex].tangent == tangent)) {
            continue;  // without a frame, any of the vertex's is as good
        }
        if (!has[vertex]) {
            has[vertex] = true;
            mesh.attributes[vertex].tangent = tangent;
            continue;
        }
        const VertexTangent key{vertex, std::bit_cast<std::array<uint32_t, 4>>(tangent)};
        const auto [found, isNew] = copies.try_emplace(key, 0U);
        if (isNew) {
            found->second = copyVertex(mesh, vertex);
            mesh.attributes[found->second].tangent = tangent;
        }
        mesh.indices[i] = found->second;
    }
}

}  // namespace reflet
