// Direct light with shadows by rays: what direct.h makes, without maps, and with all lamps. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_DIRECT_RAYS_H
#define REFLET_RENDER_DIRECT_RAYS_H

#include "base/shared.h"
#include "render/trace_scene/trace_scene.h"
#include "render/view.h"

SHARED_BEGIN

struct DirectRaysParams {
    ViewParams view;
    SceneLights lights;
    uint rays;  // to the sun, and to lamps
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// What is lit, and by what.
struct DirectRaysInputs {
    const TracedScene& scene;
    gpu::Image ggxTable;
    const EnvironmentLight& environment;  ///< the background
    const LampBlock& lamps;
};

struct DirectRays {
    gpu::Image direct;         ///< RGBA16F, as of directLight
    gpu::Image sunVisibility;  ///< R8: share of the rays to the sun's disk that nothing hides, 1 in the sky
};

DirectRays directByRays(gpu::Frame& f, const GBuffer& g, const DirectRaysInputs& in, const DirectRaysParams& params);

}  // namespace reflet
#endif

#endif
