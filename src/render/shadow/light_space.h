// Where the sun's shadow maps lie: light space (x and y across the light, z toward the sun, metres, the world's
// origin), and maps on a grid of texels that is fixed there, so that shadows' edges do not crawl when the camera moves.
#pragma once

#include "render/shadow/shadow.h"

namespace reflet {

struct LightSpace {
    mat3 worldToLight;
    vec3 toSun;  ///< world space, unit
    Aabb scene;  ///< the box of the scene's box; its z, a little longer, is the depth of every map
};

/// sceneBounds: not empty. direction: the way the light travels.
LightSpace lightSpaceOf(const Aabb& sceneBounds, const vec3& direction);

/// An eighth of an octave (9 %) or less above what is given.
float steppedUp(float metres);

/// Of `resolution` texels from `low` to `high`, as they are.
ShadowMapParams mapOf(const LightSpace& light, const glm::dvec2& low, const glm::dvec2& high, uint resolution);

/// Holds at least the part of the scene from `low` to `low + extent` and two texels more on all sides. What the sun
/// and `extent` are decides the size of a texel, and corners of texels lie at whole multiples of it.
ShadowMapParams snappedMap(const LightSpace& light, const vec2& low, const vec2& extent, uint resolution);

/// Of no scene.
ShadowMapParams emptyMap(const vec3& direction);

}  // namespace reflet
