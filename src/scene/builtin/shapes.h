// The shapes that the built-in scenes are made of: unit normals, tangents that follow uv, counter-clockwise fronts.
// Uv: u to the right and v downwards as seen from the front, so that an image stands upright. The tangent points to
// growing u and the bitangent, w · cross(n, t), to falling v (up in the image), as glTF has it.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>

namespace reflet::builtin {

/// A flat piece: corners center ± right ± up, front towards cross(right, up), uv from (0,0) to uvSize.
struct Patch {
    vec3 center{0.0F};
    vec3 right{1, 0, 0};
    vec3 up{0, 1, 0};
    glm::uvec2 cells{1};
    vec2 uvSize{1.0F};
};
Mesh patch(const Patch& p);

/// Horizontal, front up; the image's upper edge is at -z.
Mesh ground(const vec2& halfSize, const glm::uvec2& cells, const vec2& uvSize);

/// uvPerMetre 0: the whole image on every face.
Mesh box(const vec3& halfSize, float uvPerMetre = 0.0F);

/// A box with round edges of that radius, `steps` pieces from a face to an edge's middle.
Mesh roundedBox(const vec3& halfSize, float radius, unsigned steps);

Mesh sphere(float radius, unsigned segments);

/// Turns the outline (radius, height), given from the bottom to the top, about the y axis. Corners sharper than 35
/// degrees stay hard.
Mesh lathe(std::span<const vec2> outline, unsigned segments, float uvRepeat = 1.0F);

/// Stands on y = 0, with both lids.
Mesh cylinder(float radius, float height, unsigned segments);

/// Appends a vertex with both uv sets alike and without a tangent (see finish); returns its index.
uint32_t addVertex(Mesh& mesh, const vec3& position, const vec3& normal, const vec2& uv);

/// Adds `from`, moved by a rotation, a translation and a uniform scale.
void append(Mesh& to, const Mesh& from, const mat4& fromToTo);

/// Gives every triangle its own set of uv by its dominant axis, as if a box were wrapped around the mesh.
Mesh boxMapped(const Mesh& mesh, float uvPerMetre);

/// Fills tangents (from positions and uv) and bounds.
void finish(Mesh& mesh);

/// Colours in [0, 1], linear, as vertices store them.
glm::u16vec4 vertexColor(const vec3& color);

}  // namespace reflet::builtin
