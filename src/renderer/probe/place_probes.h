// Automatic placement of reflection probes.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// Places at most `count` probes, deterministically. None for an empty scene, and none if less than 0.2 of the camera's
/// view is lit by other surfaces, as for a single object: a probe beside it would hide the sky from its other side.
/// Candidates are centres of grid cells and of segments of light paths from the camera. Probes are chosen by greedy
/// maximum coverage of the surfaces that light the view; fewer than `count` if these cover nearly all. Candidates
/// inside of objects or too close to them are moved out; they are dropped if that is impossible, or if the camera sees
/// nothing of the closed space that they are in. A closed mesh that is drawn from both sides is a room, not an object,
/// if `eye`, the camera's position, is in it. A probe's box extends to the median hit distance of a few rays around
/// each axis, or to the scene's bounds if they hit nothing.
std::vector<Probe> placeProbes(const Scene& scene, uint32_t count, const vec3& eye);

}  // namespace reflet
