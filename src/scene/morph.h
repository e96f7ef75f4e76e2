// Morph targets at given weights. Pure functions.
// After: Khronos, glTF 2.0 Specification, 2021, section 3.7.2.2.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace reflet {

// `weights` has one number per morph target of the mesh, or is empty: the mesh keeps its shape.

/// The vertex in object space, before any skin. Where the sum overflows a float, the vertex stays where it is.
vec3 morphedPosition(const Mesh& mesh, size_t vertex, const std::vector<float>& weights);

/// The mesh with these weights applied, without morph targets. Normals and tangents have unit length.
Mesh morphed(const Mesh& mesh, const std::vector<float>& weights);

/// The box, which holds some of the mesh's vertices, enlarged so that it holds them with these weights. Conservative.
Aabb morphedBounds(const Mesh& mesh, const Aabb& box, const std::vector<float>& weights);

}  // namespace reflet
