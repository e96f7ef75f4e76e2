// The layers of blended surfaces in a view: peeled, lit and summed up.
#pragma once

#include "lighting/light.h"
#include "renderer/blend/blend.h"
#include "renderer/trace_lobe.h"

namespace reflet {

/// Light of blended surfaces; alpha: their transmittance for the light behind. RGBA16F.
struct BlendedSurfaces {
    LightLayers front;        ///< none: the view shows no blended surfaces
    LightLayers behindGlass;  ///< only surfaces behind the nearest glass; none: the view shows no glass
    gpu::Image depth;         ///< depth of the nearest layer
    gpu::Image motion;        ///< motion of the nearest layer
};

/// seen: the opaque surfaces, with the screen that reflections read. layers: also returns the parts of the light, not
/// only the sum.
BlendedSurfaces lightBlended(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                             bool layers);

/// Composites the blended surfaces over `behind`, into another image; returns `behind` itself if there are none.
gpu::Image withBlended(gpu::PassList& f, gpu::Image front, gpu::Image behind);
LightLayers withBlended(gpu::PassList& f, const LightLayers& front, const LightLayers& behind);
/// The same for a view's light, including its coverage of the background.
lighting::Light withBlended(gpu::PassList& f, const LightLayers& front, const lighting::Light& behind);

}  // namespace reflet
