// Points and lines, drawn as geometry: a point is an octahedron, a line a square prism, about a pixel wide.
#pragma once

#include "scene/scene.h"

#include <span>

namespace reflet {

/// Replaces the mesh's vertices by those of points (corners: 1) or of segments of lines (2), which `elements` index.
/// Its attributes, skin and morph targets go with them. Their width is provisional until widenThinMeshes.
void makeThin(Mesh& mesh, std::span<const uint32_t> elements, size_t corners);

/// Makes all points and lines of the scene a pixel wide, as seen by a camera in a picture of that height. Instances get
/// meshes of their own. From elsewhere they are as wide as they are in the world.
void widenThinMeshes(Scene& scene, const Camera& camera, uint32_t height);

}  // namespace reflet
