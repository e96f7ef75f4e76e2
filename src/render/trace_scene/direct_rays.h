// Direct light with ray-traced shadows: as direct.h, but without shadow maps and with shadows of all lamps. Shared by
// C++ and GLSL.
#ifndef REFLET_RENDER_DIRECT_RAYS_H
#define REFLET_RENDER_DIRECT_RAYS_H

#include "base/shared.h"
#include "render/trace_scene/trace_scene.h"
#include "render/view.h"

SHARED_BEGIN

struct DirectRaysParams {
    ViewParams view;
    SceneLights lights;
    uint rays;  // shadow rays to the sun, and as many to lamps
};

SHARED_END

#ifdef __cplusplus

#include "gpu/recorder.h"
#include "render/gbuffer/gbuffer.h"

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

/// Owns the images of DirectRays.
struct DirectRaysStore {
    gpu::KeptImage direct{"direct"};
    gpu::KeptImage sunVisibility{"sun_visibility"};
};

DirectRays directByRays(gpu::Recorder& f, DirectRaysStore& own, const GBuffer& g, const DirectRaysInputs& in,
                        const DirectRaysParams& params);

}  // namespace reflet
#endif

#endif
