// Meshes of basic shapes for the built-in scenes: unit normals, tangents along u, counter-clockwise front faces.
// u grows to the right and v downwards as seen from the front, so that images are upright. The tangent points to
// growing u and the bitangent, w · cross(n, t), to falling v (up in the image), as in glTF.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>

namespace reflet::builtin {

/// A flat parallelogram: corners center ± right ± up, front towards cross(right, up), uv from (0,0) to uvSize.
struct Patch {
    vec3 center{0.0F};
    vec3 right{1, 0, 0};
    vec3 up{0, 1, 0};
    glm::uvec2 cells{1};
    vec2 uvSize{1.0F};
};
Mesh patch(const Patch& p);

/// Horizontal, facing up; the image's upper edge is at -z.
Mesh ground(const vec2& halfSize, const glm::uvec2& cells, const vec2& uvSize);

/// uvPerMetre 0: the whole image on every face.
Mesh box(const vec3& halfSize, float uvPerMetre = 0.0F);

/// A box with rounded edges, `steps` segments from a face to an edge's middle.
Mesh roundedBox(const vec3& halfSize, float radius, unsigned steps);

Mesh sphere(float radius, unsigned segments);

/// Surface of revolution of the outline (radius, height), from bottom to top, about the y axis. Corners sharper than 35
/// degrees stay hard edges.
Mesh lathe(std::span<const vec2> outline, unsigned segments, float uvRepeat = 1.0F);

/// Stands on y = 0; both ends are closed.
Mesh cylinder(float radius, float height, unsigned segments);

/// Appends a vertex with equal uv sets and without a tangent (see finish); returns its index.
uint32_t addVertex(Mesh& mesh, const vec3& position, const vec3& normal, const vec2& uv);

/// Appends `from`, transformed by a rotation, a translation and a uniform scale.
void append(Mesh& to, const Mesh& from, const mat4& fromToTo);

/// Box mapping: the uvs of every triangle are projected along its dominant axis.
Mesh boxMapped(const Mesh& mesh, float uvPerMetre);

/// Computes tangents (from positions and uvs) and bounds.
void finish(Mesh& mesh);

/// Colours in [0, 1], linear, as vertices store them.
glm::u16vec4 vertexColor(const vec3& color);

}  // namespace reflet::builtin
