// Slices (slice.h) in place of diffuse rays on the screen: SSGI and ambient occlusion with a fixed number of look-ups.
// Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_TRACE_SLICES_H
#define REFLET_EFFECTS_TRACE_SLICES_H

#include "base/shared.h"
#include "effects/lobe/slice.h"

SHARED_BEGIN

struct TraceSlicesParams {
    SliceParams slice;
    uint scale;        // of RaySurfaces
    uint blockOffset;  // of the picked pixel in its block, along each side
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/generate_rays.h"

namespace reflet {

struct SliceTracing {
    SliceParams slice;
    uint32_t thickness = sliceThicknessConstant;
    bool horizon = false;  ///< everything below a surface is covered: `thickness` has no effect
    gpu::Image backDepth;  ///< for sliceThicknessLayer in ambientSlices
};

/// The screen of `screen` as the first source of the diffuse lobe, one slice per ray of in.params: rays.waiting are
/// rays into directions that the slices leave unoccluded. The screen must be the view that in.from is picked from.
Rays startSlices(gpu::PassList& f, const RayGeneration& in, const ScreenSource& screen, uint32_t steps);

/// The same in one pass, with the environment's light from unoccluded directions, and averaged.
void slicesAtOnce(gpu::PassList& f, const LobeLight& light, const RayGeneration& in, const ScreenSource& screen,
                  uint32_t steps, const EnvironmentSource& environment);

/// The visible share of white light from all directions, as the radiance of a lobe: ambient visibility.
LobeLight ambientSlices(gpu::PassList& f, const RayGeneration& in, const SliceTracing& slices);

}  // namespace reflet
#endif

#endif
