// Finds the volumes around a point by winding numbers.
#include "scene/volumes_around.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

struct Volume {
    uint32_t instance = 0;
    double size = 0.0;  // of its bounds
};

bool holds(const Aabb& box, const vec3& p) {
    return glm::all(glm::greaterThanEqual(p, box.min)) && glm::all(glm::lessThanEqual(p, box.max));
}

double sizeOf(const Aabb& box) {
    const glm::dvec3 size(box.size());
    return size.x * size.y * size.z;
}

// The winding number does not change if mesh and point are transformed alike: so the point is taken into object space.
bool isInsideRigid(const Mesh& mesh, const mat4& objectToWorld, const vec3& point) {
    const vec3 local(glm::inverse(glm::dmat4(objectToWorld)) * glm::dvec4(point, 1.0));
    return holds(mesh.bounds, local) && windingNumber(mesh.positions, mesh.indices, local) > 0.5;
}

bool isInsideDeformed(const Scene& scene, const ScenePose& pose, size_t i, const vec3& point, Aabb& bounds) {
    const Instance& instance = scene.instances[i];
    const std::vector<vec3> positions = worldPositions(scene, pose, i);
    for (const vec3& p : positions) {
        bounds.add(p);
    }
    const bool flipped = instance.skin >= 0 ? flipsWinding(pose.skins[static_cast<size_t>(instance.skin)])
                                            : glm::determinant(mat3(pose.objectToWorld[i])) < 0.0F;
    const double winding =
        holds(bounds, point) ? windingNumber(positions, scene.meshes[instance.mesh].indices, point) : 0.0;
    return (flipped ? -winding : winding) > 0.5;
}

}  // namespace

double windingNumber(std::span<const vec3> positions, std::span<const uint32_t> indices, const vec3& point) {
    double sum = 0.0;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a = glm::dvec3(positions[indices[i]]) - glm::dvec3(point);
        const glm::dvec3 b = glm::dvec3(positions[indices[i + 1]]) - glm::dvec3(point);
        const glm::dvec3 c = glm::dvec3(positions[indices[i + 2]]) - glm::dvec3(point);
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        const double height = glm::dot(a, glm::cross(b, c));
        sum += std::atan2(height, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (2.0 * glm::pi<double>());  // an atan2 is half of a solid angle
}

bool boundsVolume(const Material& material) {
    return material.transmission.factor > 0.0F && material.transmission.thickness > 0.0F;
}

std::vector<uint32_t> volumesAround(const Scene& scene, const ScenePose* pose, const vec3& point) {
    std::vector<Volume> found;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        if (!boundsVolume(scene.materials.at(mesh.material))) {
            continue;
        }
        if (pose != nullptr && isDeformed(instance)) {
            Aabb bounds;
            if (isInsideDeformed(scene, *pose, i, point, bounds)) {
                found.push_back({i, sizeOf(bounds)});
            }
            continue;
        }
        const mat4& objectToWorld = pose != nullptr ? pose->objectToWorld[i] : instance.objectToWorld;
        if (isInsideRigid(mesh, objectToWorld, point)) {
            found.push_back({i, sizeOf(transformed(mesh.bounds, objectToWorld))});
        }
    }
    // What is inside another volume is smaller.
    std::ranges::stable_sort(found, std::ranges::greater{}, &Volume::size);
    std::vector<uint32_t> instances(found.size());
    std::ranges::transform(found, instances.begin(), &Volume::instance);
    return instances;
}

std::vector<uint32_t> volumesAround(const Scene& scene, const ScenePose* pose, const Camera& camera) {
    return camera.orthographicHeight > 0.0F ? std::vector<uint32_t>{} : volumesAround(scene, pose, camera.position);
}

}  // namespace reflet
