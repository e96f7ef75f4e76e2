// Casts rays on the CPU.
#include "scene/ray_caster.h"

#include <algorithm>
#include <array>

namespace reflet {

namespace {

bool meets(const vec3& low, const vec3& high, const vec3& from, const vec3& inverse, float farthest) {
    const vec3 a = (low - from) * inverse;
    const vec3 b = (high - from) * inverse;
    const vec3 near = glm::min(a, b);
    const vec3 far = glm::max(a, b);
    return std::max({near.x, near.y, near.z, 0.0F}) <= std::min({far.x, far.y, far.z, farthest});
}

Bvh bvhOf(const Mesh& mesh) {
    std::vector<SceneTriangle> triangles;
    triangles.reserve(mesh.indices.size() / 3);
    for (uint32_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        SceneTriangle t{};
        t.a = mesh.positions[mesh.indices[i]];
        t.b = mesh.positions[mesh.indices[i + 1]];
        t.c = mesh.positions[mesh.indices[i + 2]];
        t.firstIndex = i;
        triangles.push_back(t);
    }
    return buildBvh(triangles);
}

// Components that are 0 would make NaNs of bounds that touch the origin.
vec3 inverseOf(const vec3& direction) {
    vec3 inverse;
    for (int c = 0; c < 3; ++c) {
        inverse[c] = 1.0F / (std::abs(direction[c]) > 1e-20F ? direction[c] : 1e-20F);
    }
    return inverse;
}

}  // namespace

RayCaster::RayCaster(const Scene& scene) : scene_(scene), meshes_(scene.meshes.size()) {
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (!meshes_[instance.mesh]) {
            meshes_[instance.mesh] = bvhOf(mesh);
        }
        const mat4& toWorld = instance.objectToWorld;
        const Material& material = scene.materials[mesh.material];
        placed_.push_back({transformed(mesh.bounds, toWorld), mat4(glm::inverse(glm::dmat4(toWorld))),
                           glm::determinant(mat3(toWorld)) < 0.0F, material.doubleSided,
                           !material.blended && !(material.transmission.factor > 0.0F) &&
                               !(material.diffuseTransmission.factor > 0.0F)});
    }
}

// Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997. Distances are those in the world, as the
// direction is not normalized in object space.
void RayCaster::castInto(uint32_t instance, const vec3& from, const vec3& direction, Faces faces, Hit& nearest) const {
    const Placed& placed = placed_[instance];
    const Bvh& bvh = *meshes_[scene_.instances[instance].mesh];
    const vec3 origin(placed.toObject * vec4(from, 1.0F));
    const vec3 along(placed.toObject * vec4(direction, 0.0F));
    const vec3 inverse = inverseOf(along);
    const bool culls = faces == Faces::drawn && !placed.doubleSided;
    std::array<uint32_t, 2 * bvhMaxDepth> stack{};
    size_t open = 0;
    bool found = false;
    stack[open++] = 0;
    const auto leaf = [&](uint32_t child) {
        const uint32_t first = child & bvhFirstMask;
        const uint32_t count = ((child >> bvhCountShift) & (bvhMaxLeaf - 1)) + 1;
        for (uint32_t i = first; i < first + count; ++i) {
            const SceneTriangle& t = bvh.triangles[i];
            const vec3 edge1 = t.b - t.a;
            const vec3 edge2 = t.c - t.a;
            const vec3 p = glm::cross(along, edge2);
            const float determinant = glm::dot(edge1, p);
            const bool back = (determinant < 0.0F) != placed.mirrored;
            if (determinant == 0.0F || (culls && back)) {
                continue;
            }
            const vec3 s = (origin - t.a) / determinant;
            const float u = glm::dot(s, p);
            const vec3 q = glm::cross(s, edge1);
            const float v = glm::dot(along, q);
            const float distance = glm::dot(edge2, q);
            if (u >= 0.0F && v >= 0.0F && u + v <= 1.0F && distance > 0.0F && distance < nearest.distance) {
                nearest = {distance, instance, back, glm::cross(edge1, edge2)};
                found = true;
            }
        }
    };
    while (open > 0) {
        const BvhNode& node = bvh.nodes[stack[--open]];
        const auto visit = [&](uint32_t child, const vec3& low, const vec3& high) {
            if (!meets(low, high, origin, inverse, nearest.distance)) {
                return;
            }
            if ((child & bvhLeaf) != 0) {
                leaf(child);
            } else {
                stack[open++] = child;
            }
        };
        visit(node.left, node.leftMin, node.leftMax);
        visit(node.right, node.rightMin, node.rightMax);
    }
    if (found) {
        const vec3 normal = glm::transpose(mat3(placed.toObject)) * nearest.normal;
        const float length = glm::length(normal);
        nearest.normal = length > 0.0F ? normal * ((glm::dot(normal, direction) > 0.0F ? -1.0F : 1.0F) / length)
                                       : -glm::normalize(direction);
    }
}

RayCaster::Hit RayCaster::cast(const vec3& from, const vec3& direction, Faces faces) const {
    Hit nearest;
    const vec3 inverse = inverseOf(direction);
    for (uint32_t i = 0; i < placed_.size(); ++i) {
        const bool counts = faces != Faces::blocking || placed_[i].blocks;
        if (counts && meets(placed_[i].bounds.min, placed_[i].bounds.max, from, inverse, nearest.distance)) {
            castInto(i, from, direction, faces, nearest);
        }
    }
    return nearest;
}

RayCaster::Hit RayCaster::castAt(uint32_t instance, const vec3& from, const vec3& direction) const {
    Hit nearest;
    castInto(instance, from, direction, Faces::all, nearest);
    return nearest;
}

}  // namespace reflet
