// A bounding volume hierarchy over a scene's triangles, for rays on the device.
// I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007: the surface area heuristic at bins.
#pragma once

#include "scene/bvh_layout.h"
#include "scene/pose.h"

#include <vector>

namespace reflet {

enum class Instances : uint8_t {
    all,
    standing,  ///< what is at the same place at all times
    moving,
};

/// All triangles of these instances, in the world, in the order of instances and indices. Those with a corner that is
/// not finite (or beyond 1e18 m) are left out. Throws Error: more than the hierarchy can number (2^28).
std::vector<SceneTriangle> sceneTriangles(const Scene& scene, const ScenePose& pose, Instances which = Instances::all);
/// At time 0.
std::vector<SceneTriangle> sceneTriangles(const Scene& scene);

struct Bvh {
    std::vector<BvhNode> nodes;            ///< the root first; never empty
    std::vector<SceneTriangle> triangles;  ///< in the order of leaves; never empty: one without area stands for none
};

/// The same hierarchy for the same triangles. maxDepth: nodes from the root to a leaf, at most.
Bvh buildBvh(const std::vector<SceneTriangle>& triangles, uint32_t maxDepth = bvhMaxDepth);

/// One hierarchy over two, each of at most bvhMaxDepth - 1 nodes to a leaf: what stands still need not be built anew
/// when something moves.
Bvh joined(const Bvh& a, const Bvh& b);

}  // namespace reflet
