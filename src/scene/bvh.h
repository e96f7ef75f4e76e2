// A bounding volume hierarchy over a scene's triangles, for rays on the device.
// I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007: the surface area heuristic at bins.
#pragma once

#include "scene/bvh_layout.h"
#include "scene/scene.h"

#include <vector>

namespace reflet {

/// All triangles of all instances, in the world, in the order of instances and indices. Those with a corner that is not
/// finite (or beyond 1e18 m) are left out. Throws Error: more than the hierarchy can number (2^28).
std::vector<SceneTriangle> sceneTriangles(const Scene& scene);

struct Bvh {
    std::vector<BvhNode> nodes;            ///< the root first; never empty
    std::vector<SceneTriangle> triangles;  ///< in the order of leaves; never empty: one without area stands for none
};

/// The same hierarchy for the same triangles.
Bvh buildBvh(const std::vector<SceneTriangle>& triangles);

}  // namespace reflet
