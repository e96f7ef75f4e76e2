// Finds random cameras in a scene's free space with a useful view.
#pragma once

#include "dataset/draws.h"
#include "reference/ray_scene.h"

#include <optional>

namespace reflet {

/// What a random camera must see, by 16x9 rays. A scale is the median distance that the scene's own camera has to the
/// surfaces around it.
struct CameraLimits {
    float mostSky = 0.7F;     ///< share of rays that hit nothing
    float nearest = 0.02F;    ///< scales between the camera and any surface around it
    float near = 0.15F;       ///< scales; a surface nearer than this is in the way
    float mostNear = 0.3F;    ///< share of rays that hit such a surface
    float farthest = 8.0F;    ///< scales; the median distance of what is seen
    float mostBacks = 0.05F;  ///< share of rays that hit the back of a single-sided surface
    float mostEven = 0.985F;  ///< length of the mean normal of what is seen: 1 is a single plane
    uint32_t tries = 512;
};

struct FoundCamera {
    Camera camera;
    float distance = 0.0F;  ///< median of what it sees [m]
    uint32_t tries = 0;     ///< cameras that were drawn
};

/// A random walk in free space from `start`, which must be in it: so positions are never inside of objects, and stay
/// where rays from the scene's own camera get to in three steps. It looks at something that `start` sees, in a quarter
/// of the cases anywhere. height: above the floor [m];
/// Kind::none: wherever the walk ends. fov: vertical, degrees. aspect: width over height. nullopt: none of the tries
/// kept the limits.
std::optional<FoundCamera> findCamera(const RayScene& rays, const Camera& start, float aspect,
                                      const Distribution& height, const Distribution& fov, Draws& draws,
                                      const CameraLimits& limits = {});

}  // namespace reflet
