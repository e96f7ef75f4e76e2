// Helpers to animate a built-in scene, whose first animation gets all channels.
#pragma once

#include "scene/scene.h"

namespace reflet::builtin {

/// Returns the node's index.
int32_t addNode(Scene& scene, const glm::dvec3& translation, int32_t parent = -1);

/// Adds a channel of the node.
void animate(Scene& scene, int32_t node, Channel channel);

/// Quaternion x, y, z, w of a rotation about an axis by an angle in degrees.
vec4 rotation(double degrees, const glm::dvec3& axis);

/// A node that rests at `from` and moves to `to` in a straight line from second 0 to `seconds`.
int32_t addSlidingNode(Scene& scene, const vec3& from, const vec3& to, float seconds);

/// A node that turns about the axis through its origin, by keys of at most 90 degrees, from second 0 to `seconds`.
int32_t addTurningNode(Scene& scene, const vec3& origin, const vec3& axis, float degrees, float seconds);

}  // namespace reflet::builtin
