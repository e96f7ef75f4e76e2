// Generates or repairs normals and tangents of a glTF primitive.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace reflet {

/// v normalized; `fallback` if v has no direction (zero, infinite or NaN).
vec3 unitOr(const vec3& v, const vec3& fallback);

/// A unit vector perpendicular to the unit vector n.
vec3 perpendicular(const vec3& n);

/// Gives every triangle its own vertices with the triangle's normal (+Y for degenerate triangles).
void makeFlat(Mesh& mesh);

/// Normalizes the normals. Those without a direction become the area-weighted average of the triangles at the vertex,
/// or
/// +Y. Returns how many had none.
size_t repairNormals(Mesh& mesh);

/// Normalizes the tangents, with w = ±1. Those without a direction become any perpendicular to the normal.
void repairTangents(Mesh& mesh);

/// Computes tangents for a texture of directions, such as a normal map, by MikkTSpace (scene/tangent_space.h), as
/// glTF 2.0 asks for. Vertices that need several are split. Needs unit normals.
void makeTangents(Mesh& mesh, const TextureSlot& texture);

}  // namespace reflet
