// Light space of the sun (x and y perpendicular to the light, z toward the sun, in metres, at the world's origin), and
// shadow maps snapped to a texel grid fixed there, so that shadow edges do not shimmer under camera motion.
#pragma once

#include "effects/shadow/shadow.h"

namespace reflet {

struct LightSpace {
    mat3 worldToLight;
    vec3 toSun;  ///< world space, unit
    Aabb scene;  ///< scene bounds in light space; its z range, slightly padded, is the depth range of every map
};

/// sceneBounds: not empty. direction: direction of travel of the light.
LightSpace lightSpaceOf(const Aabb& sceneBounds, const vec3& direction);

/// Bounds, in the space of `axes` (from world space), of the part of a box that a view shows.
Aabb visibleBounds(const Aabb& box, const mat4& clipToWorld, const mat3& axes);

/// Rounds up to the next eighth of an octave (steps of 9 %).
float steppedUp(float metres);

/// A map of `resolution` texels from `low` to `high`, without snapping.
ShadowMapParams mapOf(const LightSpace& light, const glm::dvec2& low, const glm::dvec2& high, uint resolution);

/// Covers at least the part of the scene from `low` to `low + extent` plus two texels on all sides. The texel size
/// depends only on sun direction and `extent`; texel corners are at whole multiples of it.
ShadowMapParams snappedMap(const LightSpace& light, const vec2& low, const vec2& extent, uint resolution);

/// The map of an empty scene.
ShadowMapParams emptyMap(const vec3& direction);

}  // namespace reflet
