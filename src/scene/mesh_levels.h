// Levels of detail of meshes that are placed many times.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// A simplified version of a mesh, with the mesh's own vertices.
struct MeshLevel {
    std::vector<uint32_t> indices;  ///< triangles
    float error = 0.0F;             ///< distance from the mesh's surface, in object space: at most about this
    float edge = 0.0F;              ///< length of its longest edge, in object space
};

/// Levels of every mesh that is rigid, has many triangles and is placed often, from fine to coarse; empty for others.
/// Each has at most two thirds of the triangles of the one before (M. Garland, P. Heckbert, Surface Simplification
/// Using Quadric Error Metrics, 1997, as the meshoptimizer library does it).
std::vector<std::vector<MeshLevel>> meshLevels(const Scene& scene);

}  // namespace reflet
