// Mesh helpers: adding vertices, tangents and bounds, merging meshes.
#include "scene/builtin/shapes.h"

#include <cmath>
#include <vector>

namespace reflet::builtin {
namespace {

vec3 anyPerpendicular(const vec3& n) {
    const vec3 axis = std::abs(n.x) < 0.7F ? vec3(1, 0, 0) : vec3(0, 0, 1);
    return glm::normalize(glm::cross(n, axis));
}

}  // namespace

uint32_t addVertex(Mesh& mesh, const vec3& position, const vec3& normal, const vec2& uv) {
    mesh.positions.push_back(position);
    VertexAttributes attributes;
    attributes.normal = glm::normalize(normal);
    attributes.uv0 = uv;
    attributes.uv1 = uv;
    mesh.attributes.push_back(attributes);
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

void append(Mesh& to, const Mesh& from, const mat4& fromToTo) {
    const auto first = static_cast<uint32_t>(to.positions.size());
    const mat3 turn(fromToTo);
    for (size_t i = 0; i < from.positions.size(); ++i) {
        to.positions.emplace_back(fromToTo * vec4(from.positions[i], 1.0F));
        VertexAttributes a = from.attributes[i];
        a.normal = glm::normalize(turn * a.normal);
        a.tangent = vec4(glm::normalize(turn * vec3(a.tangent)), a.tangent.w);
        to.attributes.push_back(a);
    }
    for (const uint32_t index : from.indices) {
        to.indices.push_back(first + index);
    }
    to.bounds = Aabb{};
    for (const vec3& p : to.positions) {
        to.bounds.add(p);
    }
}

void finish(Mesh& mesh) {
    std::vector<vec3> sums(mesh.positions.size(), vec3(0.0F));
    std::vector<float> handedness(mesh.positions.size(), 0.0F);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t* t = &mesh.indices[i];
        const vec3 p1 = mesh.positions[t[1]] - mesh.positions[t[0]];
        const vec3 p2 = mesh.positions[t[2]] - mesh.positions[t[0]];
        const vec2 uv1 = mesh.attributes[t[1]].uv0 - mesh.attributes[t[0]].uv0;
        const vec2 uv2 = mesh.attributes[t[2]].uv0 - mesh.attributes[t[0]].uv0;
        const float area = uv1.x * uv2.y - uv2.x * uv1.y;
        const vec3 alongU = (p1 * uv2.y - p2 * uv1.y) * (area < 0.0F ? -1.0F : 1.0F);
        for (int k = 0; k < 3; ++k) {
            sums[t[k]] += alongU;
            handedness[t[k]] -= area;  // counter-clockwise with v downwards: negative, an unmirrored image
        }
    }
    mesh.bounds = Aabb{};
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const vec3 n = mesh.attributes[i].normal;
        const vec3 t = sums[i] - n * glm::dot(n, sums[i]);
        const float length = glm::length(t);
        mesh.attributes[i].tangent =
            vec4(length > 1e-12F ? t / length : anyPerpendicular(n), handedness[i] < 0.0F ? -1 : 1);
        mesh.bounds.add(mesh.positions[i]);
    }
}

glm::u16vec4 vertexColor(const vec3& color) {
    const vec3 c = glm::clamp(color, 0.0F, 1.0F) * 65535.0F + 0.5F;
    return {static_cast<uint16_t>(c.x), static_cast<uint16_t>(c.y), static_cast<uint16_t>(c.z), 65535};
}

}  // namespace reflet::builtin
