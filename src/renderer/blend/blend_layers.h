// The layers of blended surfaces in a view: peeled, lit and summed up.
#pragma once

#include "renderer/blend/blend.h"
#include "renderer/coat/coat.h"
#include "renderer/gbuffer/draw_gbuffer.h"
#include "renderer/lit_layer.h"

namespace reflet {

/// Light of blended surfaces, and in alpha what they let through of the light behind. RGBA16F.
struct BlendedLight {
    gpu::Image lit;  ///< none: the view shows no blended surfaces
    gpu::Image direct;
    gpu::Image indirectDiffuse;
    gpu::Image indirectSpecular;
};

struct BlendedSurfaces {
    BlendedLight front;
    BlendedLight behindGlass;  ///< those behind the nearest glass; none: the view shows no glass
};

/// seen: the opaque surfaces, with the screen that reflections read. glassDepth: of the nearest glass, or none. layers:
/// also the parts of the light, not only lit.
BlendedSurfaces lightBlended(gpu::Recorder& f, const ViewInputs& in, const Settings& asked, const TracedView& seen,
                             gpu::Image glassDepth, bool layers);

/// `behind` with the blended surfaces in front of it, in another image; `behind` itself if there are none.
gpu::Image withBlended(gpu::Recorder& f, gpu::Image front, gpu::Image behind);

/// The same for the light and its layers. lit: the image of the sum; none: one of this frame.
LightLayers withBlended(gpu::Recorder& f, const BlendedLight& front, const LightLayers& behind, gpu::Image lit = {});

}  // namespace reflet
