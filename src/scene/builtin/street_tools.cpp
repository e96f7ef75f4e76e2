// Shapes and materials that several parts of the built-in scene "street" use.
#include "scene/builtin/assemble.h"
#include "scene/builtin/street.h"

#include <cmath>
#include <vector>

namespace reflet::builtin::street {
namespace {

vec3 perpendicular(const vec3& along) {
    const vec3 axis = std::abs(along.y) < 0.9F ? vec3(0, 1, 0) : vec3(0, 0, 1);
    return glm::normalize(glm::cross(axis, along));
}

// The vector after the smallest rotation that takes one unit vector to another, which must not be its opposite.
vec3 turnedWith(const vec3& v, const vec3& from, const vec3& to) {
    const vec3 axis = glm::cross(from, to);
    const float cosine = glm::dot(from, to);
    return cosine * v + glm::cross(axis, v) + axis * glm::dot(axis, v) / (1.0F + cosine);
}

}  // namespace

mat4 side(bool left, float z) {
    return at({left ? -frontX : frontX, 0, z}) * turned(left ? 90.0F : -90.0F);
}

Mesh tube(std::span<const vec3> line, float radius, unsigned sides) {
    Mesh mesh;
    vec3 into = glm::normalize(line[1] - line[0]);
    vec3 x = perpendicular(into);  // turns with the line, and not about it
    float travelled = 0.0F;
    for (size_t i = 0; i < line.size(); ++i) {
        const size_t next = std::min(i + 1, line.size() - 1);
        const vec3 out = glm::normalize(line[next] - line[next - 1]);
        const vec3 along = glm::normalize(into + out);
        const vec3 corner = turnedWith(x, into, along);
        const vec3 y = glm::cross(along, corner);
        x = turnedWith(x, into, out);
        into = out;
        travelled += i > 0 ? glm::distance(line[i], line[i - 1]) : 0.0F;
        for (unsigned s = 0; s <= sides; ++s) {
            const float u = static_cast<float>(s) / static_cast<float>(sides);
            const float angle = 2.0F * pi * (s == sides ? 0.0F : u);
            const vec3 n = std::cos(angle) * corner + std::sin(angle) * y;
            addVertex(mesh, line[i] + radius * n, n, {u, -travelled});
        }
    }
    for (uint32_t i = 0; i + 1 < line.size(); ++i) {
        for (uint32_t s = 0; s < sides; ++s) {
            const uint32_t a = i * (sides + 1) + s;
            const uint32_t b = a + sides + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }
    finish(mesh);
    return mesh;
}

Mesh cable(const vec3& from, const vec3& to, float sag, float radius) {
    std::vector<vec3> line;
    constexpr int pieces = 24;
    for (int i = 0; i <= pieces; ++i) {
        const float t = static_cast<float>(i) / pieces;
        line.push_back(glm::mix(from, to, t) - vec3(0, 4.0F * sag * t * (1.0F - t), 0));
    }
    return tube(line, radius, 6);
}

uint32_t addGlow(Scene& scene, const std::string& name, const vec3& radiance) {
    Material m = plain(name, {0x101010, 0.5F});
    m.emissive = radiance;
    return addMaterial(scene, m);
}

void addQuad(Mesh& mesh, const vec3& corner, const vec3& right, const vec3& up) {
    const vec3 normal = glm::normalize(glm::cross(right, up));
    const vec3 r = glm::normalize(right);
    const vec3 u = glm::normalize(up);
    uint32_t first = 0;
    for (int i = 0; i < 4; ++i) {
        const vec3 p = corner + (i == 1 || i == 2 ? right : vec3(0)) + (i >= 2 ? up : vec3(0));
        const uint32_t index = addVertex(mesh, p, normal, {glm::dot(p, r), -glm::dot(p, u)});
        first = i == 0 ? index : first;
    }
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

}  // namespace reflet::builtin::street
