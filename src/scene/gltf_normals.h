// Normals and tangents that a glTF primitive does not have, or has without a direction.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace reflet {

/// v at unit length; `fallback` where v has no direction (zero, infinite or NaN).
vec3 unitOr(const vec3& v, const vec3& fallback);

/// Some unit vector at a right angle to the unit vector n.
vec3 perpendicular(const vec3& n);

/// Gives every triangle vertices of its own, with the triangle's normal (+Y where it has no area).
void makeFlat(Mesh& mesh);

/// Makes the normals unit vectors. Those without a direction become the average of the triangles at the vertex,
/// weighted with their areas, or +Y. Returns how many had none.
size_t repairNormals(Mesh& mesh);

/// Makes the tangents unit vectors with w = ±1; those without a direction become any at a right angle to the normal.
void repairTangents(Mesh& mesh);

/// Computes tangents for a normal map as glTF 2.0 has them (w · cross(n, t) is up in the image): per vertex the average
/// over the triangles there, weighted with their angles. Vertices alike in position, normal and uv are averaged
/// together; where triangles of both handednesses meet, the vertex is split. After: Morten S. Mikkelsen, "Simulation of
/// Wrinkled Surfaces Revisited", 2008. Needs unit normals.
void makeTangents(Mesh& mesh, const TextureSlot& normalTexture);

}  // namespace reflet
