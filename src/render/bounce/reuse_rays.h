// Rays back into pixels, in the place of resolveRays: each pixel takes its own and those of neighbours, whose hits it
// would have met by its own rays with another chance. Shared by C++ and GLSL.
//
// (After Stachowiak and Uludag, Stochastic Screen-Space Reflections, SIGGRAPH 2015.)
#ifndef REFLET_RENDER_REUSE_RAYS_H
#define REFLET_RENDER_REUSE_RAYS_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

struct ReuseRaysParams {
    ViewParams view;  // of the grid
    uint rayCount;    // per pixel
    uint neighbours;
    float gridAngle;  // what a pixel of the grid covers at distance 1 [m/m]; orthographic: at any distance [m]
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/bounce/rays.h"

namespace reflet {

/// All rays of the lobe, in one batch, into its images: radiance is the mean over own and borrowed rays, weighted by
/// what the pixel's own lobe makes of each over the chance with which it was drawn. Source and steps are those of its
/// own rays. Mirrors, and rays that stand for more than their direction, borrow nothing. picture: the whole picture's
/// view.
LobeLight reuseRays(gpu::Frame& f, const Rays& rays, const ViewParams& picture, uint32_t neighbours);

}  // namespace reflet
#endif

#endif
