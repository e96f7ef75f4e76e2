// Direct light with ray-traced shadows: like direct.h, but without shadow maps, and all lamps cast shadows. Shared by
// C++ and GLSL.
#ifndef REFLET_RENDERER_DIRECT_RAYS_H
#define REFLET_RENDERER_DIRECT_RAYS_H

#include "base/shared.h"
#include "effects/view.h"
#include "renderer/trace_scene/trace_scene.h"

SHARED_BEGIN

struct DirectRaysParams {
    ViewParams view;
    SceneLights lights;
    uint rays;  // number of shadow rays to the sun, and the same number to lamps
};

SHARED_END

#ifdef __cplusplus

#include "effects/gbuffer/gbuffer.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Inputs of shading.
struct DirectRaysInputs {
    const TracedScene& scene;
    gpu::Image ggxTable;
    const EnvironmentLight& environment;  ///< the background
    const LampBlock& lamps;
};

struct DirectRays {
    gpu::Image direct;         ///< RGBA16F, as by directLight
    gpu::Image sunVisibility;  ///< R8: unoccluded share of the rays to the sun's disk, 1 for the sky
};

DirectRays directByRays(gpu::PassList& f, const GBuffer& g, const DirectRaysInputs& in, const DirectRaysParams& params);

}  // namespace reflet
#endif

#endif
