// Coarse bounds of a mesh: where in its bounding box it is.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace reflet {

/// Bounds of at most 1024 groups of neighbouring triangles, in object space; all of them together hold the mesh.
std::vector<Aabb> meshPieces(const Mesh& mesh);

}  // namespace reflet
