// Subpixel jitter: a new sample position in the pixel for every frame, so that the mean over frames is antialiased.
#pragma once

#include "effects/view.h"

namespace reflet {

/// Jitter of frame `index`: -0.5 to 0.5 pixels from the pixel's centre, 0 for the first frame. A (0, 2)-sequence: 2^n
/// successive frames from a multiple of 2^n have one sample in each cell of every grid of 2^n equal cells, so that with
/// temporal upscaling by 2 four frames have one in each pixel. (base/sobol.h)
vec2 subpixelJitter(uint32_t index);

/// Shifts the projection so that pixel centres show what was `jitter` pixels away. The last frame's matrix gets the
/// same shift, so motion vectors contain no jitter and are exactly 0 where nothing moves. `previousJitter` is the last
/// frame's. Also sets view.paddedClipToWorld.
void applyJitter(ViewParams& view, const vec2& jitter, const vec2& previousJitter);

}  // namespace reflet
