// Small bright emissive surfaces as sources of light: which they are, and what they send in each direction.
//
// Rays that scatter at random find a small source too rarely; a lamp in its place is free of noise. Far from a group of
// emissive triangles its radiant intensity is the radiance times the projected area, the sum of area · max(n · w, 0)
// over the triangles. That is half of (sum of area · n) · w and half of the sum of area · |n · w|; the first part is
// exact with one vector, and the second is approximated by the projected area of an ellipsoid, |S w| with a symmetric
// matrix S, which is exact for spheres, flat things and tubes.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// A group of emissive triangles, at time 0, in world space.
struct Emitter {
    uint32_t instance = 0;  ///< that it moves with
    vec3 position{0.0F};    ///< its centre
    vec3 radiance{0.0F};    ///< mean over its area [W/(m² sr)]
    vec3 facing{0.0F};      ///< half of the sum of area times normal [m²]
    mat3 shape{0.0F};       ///< S, symmetric [m²]
    mat3 covariance{0.0F};  ///< of its points about the centre [m²]
    float radius = 0.0F;    ///< of a sphere that holds it [m]
    float softening =
        0.0F;  ///< added to squared distances: what is not round has no point from which all light comes [m²]
};

struct SceneEmitters {
    std::vector<Emitter> all;
    std::vector<bool> materials;  ///< per material: the emitters are all its light
};

/// At most `most` of them. Materials whose surfaces are large as seen from what they light, or dim beside the other
/// lights, have none: rays find these well. Nor do surfaces that change their shape, or may let light through.
SceneEmitters findEmitters(const Scene& scene, uint32_t most);

}  // namespace reflet
