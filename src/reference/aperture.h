// Points on the aperture of a lens.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet {

/// Maps u, uniform in [0, 1)², to a uniform point of the unit disk, or of the regular polygon inscribed in it. blades:
/// number of corners; 0: the disk. rotation: of the polygon, in radians; 0: a corner at (1, 0).
vec2 onAperture(const vec2& u, uint32_t blades, float rotation);

}  // namespace reflet
