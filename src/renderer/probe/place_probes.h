// Automatic placement of reflection probes.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// At most `count` probes, deterministic. None for an empty scene, and none where other surfaces light less than 0.2 of
/// what the camera sees, as of a single object: a probe beside it would hide the sky from its other side. Each stands
/// where it shows most of what lights the scene and is not yet shown by the others, from middles of cells and of rays
/// that go from the camera as light does; fewer than `count` if these show nearly all. Places inside of objects or too
/// close to them are moved out, and left out where there is no way out or where the camera sees nothing of the closed
/// space that they are in; a closed mesh that is drawn from both sides is a room, not an object, if `eye`, the camera's
/// position, is in it. A probe's box extends to the median hit distance of a few rays around each axis, or to the
/// scene's bounds if they hit nothing.
std::vector<Probe> placeProbes(const Scene& scene, uint32_t count, const vec3& eye);

}  // namespace reflet
