// Simplifies meshes step by step.
#include "scene/mesh_levels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

// Below these numbers a mesh is drawn faster than its levels are made.
constexpr size_t fewestOfMesh = 256;          // of a mesh
constexpr size_t fewestInstances = 8;         // of a mesh
constexpr size_t fewestPlaced = 200'000;      // triangles of all its instances
constexpr size_t coarsestTriangles = 16;      // of a level that is simplified further
constexpr float mostRelativeError = 0.25F;    // of a step, relative to the mesh's size
constexpr float largestRemainder = 2.0F / 3;  // of the triangles; a level that saves less is not worth its memory

float longestEdge(const Mesh& mesh, const std::vector<uint32_t>& indices) {
    float longest2 = 0.0F;
    for (size_t i = 0; i < indices.size(); ++i) {
        const size_t next = i % 3 == 2 ? i - 2 : i + 1;
        const vec3 edge = mesh.positions[indices[next]] - mesh.positions[indices[i]];
        longest2 = std::max(longest2, glm::dot(edge, edge));
    }
    return std::sqrt(longest2);
}

std::vector<MeshLevel> levelsOf(const Mesh& mesh) {
    std::vector<MeshLevel> levels;
    const float* positions = &mesh.positions.front().x;
    const float scale = meshopt_simplifyScale(positions, mesh.positions.size(), sizeof(vec3));
    float error = 0.0F;
    const std::vector<uint32_t>* from = &mesh.indices;
    while (from->size() / 3 > coarsestTriangles) {
        std::vector<uint32_t> indices(from->size());
        float stepError = 0.0F;
        indices.resize(meshopt_simplify(indices.data(), from->data(), from->size(), positions, mesh.positions.size(),
                                        sizeof(vec3), from->size() / 6 * 3, mostRelativeError, 0, &stepError));
        if (indices.empty() ||
            static_cast<float>(indices.size()) > largestRemainder * static_cast<float>(from->size())) {
            break;
        }
        error += stepError * scale;  // each step's error is relative to the level before
        const float edge = longestEdge(mesh, indices);
        levels.push_back({std::move(indices), error, edge});
        from = &levels.back().indices;
    }
    return levels;
}

bool isRigid(const Mesh& mesh) {
    return mesh.skin.empty() && mesh.morph.deltas.empty() && mesh.outward.empty();
}

}  // namespace

std::vector<std::vector<MeshLevel>> meshLevels(const Scene& scene) {
    std::vector<size_t> placed(scene.meshes.size());
    for (const Instance& instance : scene.instances) {
        ++placed[instance.mesh];
    }
    std::vector<std::vector<MeshLevel>> levels(scene.meshes.size());
    for (size_t i = 0; i < levels.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const size_t triangles = mesh.indices.size() / 3;
        const bool worthIt =
            triangles >= fewestOfMesh && placed[i] >= fewestInstances && triangles * placed[i] >= fewestPlaced;
        if (worthIt && isRigid(mesh)) {
            levels[i] = levelsOf(mesh);
        }
    }
    return levels;
}

}  // namespace reflet
