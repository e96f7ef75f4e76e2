// Keyframe interpolation.
#pragma once

#include "scene/animation.h"

namespace reflet {

/// Translation or scale in x, y, z; rotation: a unit quaternion x, y, z, w. Exact at the keys.
glm::dvec4 sampleChannel(const Channel& channel, double time);

}  // namespace reflet
