// Places probes where nobody has.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// At most `count` probes (none for 0, else at least one), always the same for the same scene; none for an empty one.
/// The scene's bounds are cut into cells, halving and so on where they are longest, a probe in each cell's middle. One
/// that stands inside of something or too near to it is moved out. A box reaches as far as most of some rays around
/// each axis do; where those meet nothing, to the scene's bounds.
std::vector<Probe> placeProbes(const Scene& scene, uint32_t count);

}  // namespace reflet
