// Puts the lobes' light on the surfaces and adds it to the direct light. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_COMPOSITE_H
#define REFLET_RENDER_COMPOSITE_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

struct CompositeParams {
    ViewParams view;
    float diffuseGain;  // factor on indirect diffuse light
    uint diffusePlace;  // which pixel of a block its rays leave, along each side (RaySurfaces)
    uint specularPlace;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/bounce/rays.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// RGBA16F radiance: lit = direct + indirectDiffuse + indirectSpecular.
struct Composite {
    gpu::Image indirectDiffuse;
    gpu::Image indirectSpecular;
    gpu::Image lit;
};

/// Lobes whose rays leave a coarser grid are spread over all pixels. params: places are set here. lit: written.
Composite composite(gpu::Frame& f, const GBuffer& g, gpu::Image direct, const LobeLight& diffuse,
                    const LobeLight& specular, gpu::Image ggxTable, gpu::Image lit, CompositeParams params);

}  // namespace reflet
#endif

#endif
