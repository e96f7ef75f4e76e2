// Ray reuse, in place of resolveRays: each pixel averages its own rays and those of its neighbours, reweighted by its
// own lobe. Shared by C++ and GLSL.
//
// (After Stachowiak and Uludag, Stochastic Screen-Space Reflections, SIGGRAPH 2015.)
#ifndef REFLET_EFFECTS_REUSE_RAYS_H
#define REFLET_EFFECTS_REUSE_RAYS_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

struct ReuseRaysParams {
    ViewParams view;  // of the grid
    uint rayCount;    // per pixel
    uint neighbours;
    float gridAngle;  // size of a grid pixel at distance 1 [m/m]; orthographic: at any distance [m]
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Writes the images of `light`. Needs all rays of the lobe in one batch. Radiance is the mean over own and reused
/// rays, weighted by the pixel's own lobe over the pdf with which each was sampled. Source and steps are those of the
/// pixel's own rays. Mirrors and cones reuse nothing. picture: the full-resolution view.
void reuseRays(gpu::PassList& f, const LobeLight& light, const Rays& rays, const ViewParams& picture,
               uint32_t neighbours);

}  // namespace reflet
#endif

#endif
