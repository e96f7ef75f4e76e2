// Rooms that no light reaches: a viewer culls the wall in front of the camera, but light does not pass it.
#pragma once

#include "scene/scene.h"

#include <optional>

namespace reflet {

/// A lamp inside for what the camera sees, if that has no light of its own and none comes in from around it, at time 0.
/// irradiance: luminance of what it gives to surfaces at the mean distance of those that the camera sees [W/m²].
std::optional<Lamp> lampForClosedRoom(const Scene& scene, const Camera& camera, float irradiance);

}  // namespace reflet
