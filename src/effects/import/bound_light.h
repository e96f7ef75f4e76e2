// Clamps a host's light to a multiple of its peaks in the last frames, so that one frame of wrong values does not stay
// in histories. Shared by C++ and GLSL.
//
// peaks: the brightest luminance of each tile of 8x8 pixels, which falls slowly → limits: multiples of it. In motion
// any tile may become as bright as the brightest of the picture; at rest the limit depends on neighbouring tiles only.
#ifndef REFLET_EFFECTS_BOUND_LIGHT_H
#define REFLET_EFFECTS_BOUND_LIGHT_H

#include "base/shared.h"

SHARED_BEGIN

const uint boundTileSide = 8;  // pixels

const uint lightPeaksAdd = 0;    // to those that the frame has already
const uint lightPeaksStart = 1;  // there are none, neither of this frame nor of the last
const uint lightPeaksNext = 2;   // go on from the last frame's

struct LightPeakParams {
    uvec2 size;            // of the light
    uint from;             // lightPeaks…
    float exposureChange;  // of ViewParams
};

struct LightLimitsParams {
    uvec2 tiles;
    float whole;     // multiple of the picture's peak that is added to the limit
    float near;      // of that of the tiles around
    uint unbounded;  // 1: there is no limit
    float exposureChange;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/images.h"
#include "gpu/pass_list.h"

namespace reflet {

/// The peaks of a host's light in the last frames.
struct LightBoundStore {
    gpu::HistoryImage peaks{"light_peaks"};
};

/// How bright light may be in this frame.
struct LightBound {
    gpu::Image limits;  ///< R32F: luminance, a texel for each tile
    gpu::History peaks;
    float exposureChange = 1.0F;
    bool measured = false;  ///< peaks.next has light of this frame
};

/// Relation of a frame to the previous one.
struct LightBoundFrame {
    bool rests = false;           ///< nothing has changed since the last frame
    bool unbounded = false;       ///< its light may be of any luminance
    float exposureChange = 1.0F;  ///< of ViewParams
};

LightBound boundLight(gpu::PassList& f, LightBoundStore& own, uvec2 size, const LightBoundFrame& frame);

/// Measures the peaks of this frame's light, clamped to the limits: they determine the next frame's limits.
void measureLight(gpu::PassList& f, LightBound& bound, gpu::Image light);

}  // namespace reflet
#endif

#endif
