// Looks through another place in the pixel in every frame, so that a mean over frames is a mean over the pixel's area.
#pragma once

#include "render/view.h"

namespace reflet {

/// Where in the pixel frame `index` looks through: -0.5 to 0.5 pixels off its centre, the first in the middle. Any run
/// of successive places is spread evenly, however long. (R2: M. Roberts, "The Unreasonable Effectiveness of
/// Quasirandom Sequences", 2018)
vec2 subpixelJitter(uint32_t index);

/// Moves the picture such that pixels' centres show what was `place` pixels off them. The last frame's matrix moves
/// alike: motion is as if neither had been moved, and exactly 0 where nothing moves. `previousJitter` is the last
/// frame's. view.paddedClipToWorld is set, too.
void applyJitter(ViewParams& view, const vec2& place, const vec2& previousJitter);

}  // namespace reflet
