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

bool isInsideDeformed(const Scene& scene, const ScenePose& pose, size_t i, const vec3& point, Aabb& bounds) {
    const Instance& instance = scene.instances[i];
    const std::vector<vec3> positions = worldPositions(scene, pose, i);
    for (const vec3& p : positions) {
        bounds.add(p);
    }
    const bool flipped = instance.skin >= 0 ? flipsWinding(pose.skins[static_cast<size_t>(instance.skin)])
                                            : glm::determinant(mat3(pose.objectToWorld[i])) < 0.0F;
    const double winding =
        holds(bounds, point) ? windingAround(positions, scene.meshes[instance.mesh].indices, point).number : 0.0;
    return (flipped ? -winding : winding) > 0.5;
}

}  // namespace

Winding windingAround(std::span<const vec3> positions, std::span<const uint32_t> indices, const vec3& point) {
    Winding w;
    double sum = 0.0;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a = glm::dvec3(positions[indices[i]]) - glm::dvec3(point);
        const glm::dvec3 b = glm::dvec3(positions[indices[i + 1]]) - glm::dvec3(point);
        const glm::dvec3 c = glm::dvec3(positions[indices[i + 2]]) - glm::dvec3(point);
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        const double height = glm::dot(a, glm::cross(b, c));
        const double area = glm::length(glm::cross(b - a, c - a));
        const double toPlane = area > 0.0 ? std::abs(height) / area : 0.0;
        w.clearance = std::min(w.clearance, std::max(toPlane, la - std::max(glm::length(b - a), glm::length(c - a))));
        sum += std::atan2(height, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    w.number = sum / (2.0 * glm::pi<double>());  // an atan2 is half of a solid angle
    return w;
}

bool boundsVolume(const Material& material) {
    return material.transmission.factor > 0.0F && material.transmission.thickness > 0.0F;
}

// The winding number does not change if mesh and point are transformed alike: so the point is taken into object space,
// where the mesh always is the same.
bool VolumeFinder::isInsideRigid(const Mesh& mesh, const mat4& objectToWorld, const vec3& point, Known& known) {
    const vec3 local(glm::inverse(glm::dmat4(objectToWorld)) * glm::dvec4(point, 1.0));
    if (!holds(mesh.bounds, local)) {
        return false;
    }
    if (!(glm::distance(glm::dvec3(local), glm::dvec3(known.point)) < known.clearance)) {
        ++searches_;
        const Winding w = windingAround(mesh.positions, mesh.indices, local);
        known = {local, w.clearance, w.number > 0.5};
    }
    return known.inside;
}

std::vector<uint32_t> VolumeFinder::around(const Scene& scene, const ScenePose* pose, const vec3& point) {
    std::vector<Volume> found;
    known_.resize(scene.instances.size());
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        if (!boundsVolume(scene.materials.at(mesh.material))) {
            continue;
        }
        if (pose != nullptr && isDeformed(instance)) {
            Aabb bounds;
            ++searches_;
            if (isInsideDeformed(scene, *pose, i, point, bounds)) {
                found.push_back({i, sizeOf(bounds)});
            }
            continue;
        }
        const mat4& objectToWorld = pose != nullptr ? pose->objectToWorld[i] : instance.objectToWorld;
        if (isInsideRigid(mesh, objectToWorld, point, known_[i])) {
            found.push_back({i, sizeOf(transformed(mesh.bounds, objectToWorld))});
        }
    }
    // What is inside another volume is smaller.
    std::ranges::stable_sort(found, std::ranges::greater{}, &Volume::size);
    std::vector<uint32_t> instances(found.size());
    std::ranges::transform(found, instances.begin(), &Volume::instance);
    return instances;
}

std::vector<uint32_t> VolumeFinder::around(const Scene& scene, const ScenePose* pose, const Camera& camera) {
    return camera.orthographicHeight > 0.0F ? std::vector<uint32_t>{} : around(scene, pose, camera.position);
}

}  // namespace reflet
