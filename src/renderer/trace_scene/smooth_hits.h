// Smooths the indirect light of what mirrors and clear glass show, which one path per pixel and frame leaves grainy.
// Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_SMOOTH_HITS_H
#define REFLET_RENDERER_SMOOTH_HITS_H

#include "base/shared.h"

SHARED_BEGIN

struct SmoothHitsParams {
    uvec2 size;
    float radius;  // pixels
    uint frame;    // counts up; turns the pattern
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

namespace reflet {

/// What trace_scene keeps apart of the rays' answers: arrays of one layer per ray, 1x1 if nothing.
struct SplitHits {
    gpu::Image light;   ///< RGBA16F: incoming, that a hit reflects; alpha: 1, or 0 where there is none
    gpu::Image factor;  ///< RGBA16F: on it; alpha: distance of the hit from the eye [m]
    gpu::Image normal;  ///< R32_UINT: packUnitVector, of the hit
};

/// Images for the rays' hits, black. splits: whether they are used.
SplitHits splitHits(gpu::PassList& f, const Rays& rays, bool splits);

/// Adds the light to rays.answer, smoothed within the radius [pixels].
void smoothHits(gpu::PassList& f, const Rays& rays, const SplitHits& hits, float radius);

}  // namespace reflet
#endif

#endif
