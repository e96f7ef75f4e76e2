// Automatic placement of reflection probes.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// At most `count` probes, deterministic. None for an empty scene, and none where other surfaces light less than 0.2 of
/// what the camera sees, as of a single object: a probe beside it would hide the sky from its other side. The scene's
/// bounds are split into cells along their longest sides, with a probe at each cell's centre. Probes inside of objects
/// or too close to them are moved out, and left out where there is no way out or where the camera sees nothing of the
/// closed space that they are in; a closed mesh that is drawn from both sides is a room, not an object, if `eye`, the
/// camera's position, is in it. A probe's box extends to the median hit distance of a few rays around each axis, or to
/// the scene's bounds if they hit nothing.
std::vector<Probe> placeProbes(const Scene& scene, uint32_t count, const vec3& eye);

}  // namespace reflet
