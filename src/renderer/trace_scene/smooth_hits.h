// Denoises indirect light at hits seen in mirrors and through clear glass, which is noisy at one path per pixel and
// frame. Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_SMOOTH_HITS_H
#define REFLET_RENDERER_SMOOTH_HITS_H

#include "base/shared.h"

SHARED_BEGIN

struct SmoothHitsParams {
    uvec2 size;
    float radius;  // pixels
    uint frame;    // counts up; rotates the sample pattern
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Indirect light that trace_scene separates from the rays' answers: arrays of one layer per ray, 1x1 if unused.
struct SplitHits {
    gpu::Image light;   ///< RGBA16F: incoming light that a hit reflects; alpha: 1, or 0 where there is none
    gpu::Image factor;  ///< RGBA16F: factor on `light`; alpha: distance of the hit from the eye [m]
    gpu::Image normal;  ///< R32_UINT: normal of the hit (packUnitVector)
};

/// Images for the rays' hits, black. splits: whether they are used.
SplitHits splitHits(gpu::PassList& f, const Rays& rays, bool splits);

/// Filters `hits.light` within the radius [pixels], and adds it to rays.answer.
void smoothHits(gpu::PassList& f, const Rays& rays, const SplitHits& hits, float radius);

}  // namespace reflet
#endif

#endif
