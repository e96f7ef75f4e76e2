// Points on the aperture of a lens.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet {

/// A point of the unit disk, or of the regular polygon of that many corners on its edge, uniform over its area for u
/// uniform in [0, 1)². blades: 0: the disk. rotation: of the polygon, in radians; 0: a corner at (1, 0).
vec2 onAperture(const vec2& u, uint32_t blades, float rotation);

}  // namespace reflet
