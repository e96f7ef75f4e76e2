// Generates or repairs normals of a glTF primitive. In doubles, because the square of a float may overflow.
#include "scene/gltf/normals.h"

#include <cmath>

namespace reflet {

namespace {

/// Twice the area, along the normal.
glm::dvec3 areaVector(const Mesh& mesh, size_t triangle) {
    const glm::dvec3 a(mesh.positions[mesh.indices[3 * triangle]]);
    const glm::dvec3 b(mesh.positions[mesh.indices[3 * triangle + 1]]);
    const glm::dvec3 c(mesh.positions[mesh.indices[3 * triangle + 2]]);
    return glm::cross(b - a, c - a);
}

bool hasDirection(const vec3& v) {
    const double length = glm::length(glm::dvec3(v));
    return std::isfinite(length) && length > 0.0;
}

/// For sums in doubles, whose direction may be lost in float precision.
vec3 unitOr(const glm::dvec3& v, const vec3& fallback) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 0.0 ? vec3(v / length) : fallback;
}

}  // namespace

vec3 unitOr(const vec3& v, const vec3& fallback) {
    return unitOr(glm::dvec3(v), fallback);
}

vec3 perpendicular(const vec3& n) {
    const vec3 axis = std::abs(n.x) < 0.7F ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return glm::normalize(axis - n * glm::dot(n, axis));
}

void makeFlat(Mesh& mesh) {
    std::vector<vec3> positions;
    std::vector<VertexAttributes> attributes;
    std::vector<VertexSkin> skin;
    std::vector<Morph::Range> morph;
    positions.reserve(mesh.indices.size());
    attributes.reserve(mesh.indices.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        positions.push_back(mesh.positions[mesh.indices[i]]);
        attributes.push_back(mesh.attributes[mesh.indices[i]]);
        attributes.back().normal = unitOr(areaVector(mesh, i / 3), vec3(0, 1, 0));
        if (!mesh.skin.empty()) {
            skin.push_back(mesh.skin[mesh.indices[i]]);
        }
        if (!mesh.morph.vertices.empty()) {
            morph.push_back(mesh.morph.vertices[mesh.indices[i]]);
        }
    }
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        mesh.indices[i] = static_cast<uint32_t>(i);
    }
    mesh.positions = std::move(positions);
    mesh.attributes = std::move(attributes);
    mesh.skin = std::move(skin);
    mesh.morph.vertices = std::move(morph);
}

size_t repairNormals(Mesh& mesh) {
    size_t broken = 0;
    for (const VertexAttributes& vertex : mesh.attributes) {
        broken += hasDirection(vertex.normal) ? 0 : 1;
    }
    std::vector<glm::dvec3> sums(broken > 0 ? mesh.positions.size() : 0, glm::dvec3(0.0));
    for (size_t i = 0; broken > 0 && i < mesh.indices.size(); ++i) {
        sums[mesh.indices[i]] += areaVector(mesh, i / 3);
    }
    for (size_t v = 0; v < mesh.attributes.size(); ++v) {
        vec3& normal = mesh.attributes[v].normal;
        normal = hasDirection(normal) ? unitOr(normal, normal) : unitOr(sums[v], vec3(0, 1, 0));
    }
    return broken;
}

void repairTangents(Mesh& mesh) {
    for (VertexAttributes& vertex : mesh.attributes) {
        const vec3 tangent = unitOr(vec3(vertex.tangent), perpendicular(vertex.normal));
        vertex.tangent = vec4(tangent, vertex.tangent.w < 0.0F ? -1.0F : 1.0F);
    }
}

}  // namespace reflet
