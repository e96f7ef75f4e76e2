// Keyframe interpolation.
#pragma once

#include "scene/animation.h"

#include <vector>

namespace reflet {

/// Translation or scale in x, y, z; rotation: a unit quaternion x, y, z, w. Exact at the keys.
glm::dvec4 sampleChannel(const Channel& channel, double time);

/// Target::weights: one number per morph target. Exact at the keys.
std::vector<float> sampleWeights(const Channel& channel, double time);

}  // namespace reflet
