// Subpixel jitter: a new sample position in the pixel for every frame, so that the mean over frames is antialiased.
#pragma once

#include "effects/view.h"

namespace reflet {

/// Jitter of frame `index`: -0.5 to 0.5 pixels from the pixel's centre, 0 for the first frame. A low-discrepancy
/// sequence: any run of successive samples is evenly distributed. (R2: M. Roberts, "The Unreasonable Effectiveness of
/// Quasirandom Sequences", 2018)
vec2 subpixelJitter(uint32_t index);

/// Shifts the projection so that pixel centres show what was `jitter` pixels away. The last frame's matrix gets the
/// same shift, so motion vectors contain no jitter and are exactly 0 where nothing moves. `previousJitter` is the last
/// frame's. Also sets view.paddedClipToWorld.
void applyJitter(ViewParams& view, const vec2& jitter, const vec2& previousJitter);

}  // namespace reflet
