// A scene's triangles in world space, the input of BVH construction.
#include "scene/bvh.h"

#include "base/error.h"

#include <cmath>

namespace reflet {

namespace {

constexpr uint32_t maxTriangles = bvhFirstMask;

// Products of coordinates beyond this overflow a float [m].
constexpr float farthest = 1e18F;

bool isSomewhere(const vec3& v) {
    return std::abs(v.x) < farthest && std::abs(v.y) < farthest && std::abs(v.z) < farthest;
}

uint32_t flagsOf(const Scene& scene, const ScenePose& pose, size_t instance) {
    const Instance& placed = scene.instances[instance];
    const Material& material = scene.materials.at(scene.meshes.at(placed.mesh).material);
    const bool mirrored = placed.skin >= 0 ? flipsWinding(pose.skins[static_cast<size_t>(placed.skin)])
                                           : glm::determinant(mat3(pose.objectToWorld[instance])) < 0.0F;
    return (material.alphaCutoff > 0.0F || material.transmission.factor > 0.0F ? triangleCutOut : 0U) |
           (material.doubleSided ? triangleDoubleSided : 0U) | (mirrored ? triangleMirrored : 0U);
}

}  // namespace

std::vector<SceneTriangle> sceneTriangles(const Scene& scene, const ScenePose& pose, Instances which) {
    std::vector<uint32_t> firstIndices;  // of meshes
    uint64_t indices = 0;
    for (const Mesh& mesh : scene.meshes) {
        firstIndices.push_back(static_cast<uint32_t>(indices));
        indices += mesh.indices.size();
    }
    std::vector<SceneTriangle> triangles;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (which != Instances::all && isAnimated(pose, instance) != (which == Instances::moving)) {
            continue;
        }
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        const std::vector<vec3> positions = worldPositions(scene, pose, i);
        SceneTriangle t{};
        t.instance = i;
        t.flags = flagsOf(scene, pose, i);
        if (triangles.size() + mesh.indices.size() / 3 > maxTriangles) {
            fail("the scene has more than {} triangles, the most that ray tracing supports", maxTriangles);
        }
        for (uint32_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
            t.a = positions[mesh.indices[k]];
            t.b = positions[mesh.indices[k + 1]];
            t.c = positions[mesh.indices[k + 2]];
            t.firstIndex = firstIndices[instance.mesh] + k;
            if (isSomewhere(t.a) && isSomewhere(t.b) && isSomewhere(t.c)) {
                triangles.push_back(t);
            }
        }
    }
    return triangles;
}

std::vector<SceneTriangle> sceneTriangles(const Scene& scene) {
    return sceneTriangles(scene, scenePose(scene, 0.0));
}

}  // namespace reflet
