// A bounding volume hierarchy over a scene's triangles, for ray tracing on the GPU.
// I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007: binned SAH.
#pragma once

#include "scene/bvh_layout.h"
#include "scene/pose.h"

#include <vector>

namespace reflet {

enum class Instances : uint8_t {
    all,
    stationary,  ///< neither animated nor skinned
    moving,
};

/// All triangles of these instances in world space, in the order of instances and indices. Triangles with a vertex that
/// is not finite (or beyond 1e18 m) are left out. Throws Error if there are more than the BVH can index (2^28).
std::vector<SceneTriangle> sceneTriangles(const Scene& scene, const ScenePose& pose, Instances which = Instances::all);
/// At time 0.
std::vector<SceneTriangle> sceneTriangles(const Scene& scene);

struct Bvh {
    std::vector<BvhNode> nodes;            ///< the root first; never empty
    std::vector<SceneTriangle> triangles;  ///< in leaf order; never empty: an empty scene has one degenerate triangle
};

/// Deterministic. Of many equal triangles in one place it has one. maxDepth: maximum number of nodes from the root to a
/// leaf.
Bvh buildBvh(const std::vector<SceneTriangle>& triangles, uint32_t maxDepth = bvhMaxDepth);

/// Merges two hierarchies, each with at most bvhMaxDepth - 1 nodes to a leaf, under one root: the static part need not
/// be rebuilt when something moves.
Bvh joined(const Bvh& a, const Bvh& b);

}  // namespace reflet
