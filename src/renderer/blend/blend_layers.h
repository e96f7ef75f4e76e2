// The layers of blended surfaces in a view: peeled, lit and summed up.
#pragma once

#include "lighting/light.h"
#include "renderer/blend/blend.h"
#include "renderer/trace_lobe.h"

namespace reflet {

/// Light of blended surfaces, and in alpha what they let through of the light behind. RGBA16F.
struct BlendedSurfaces {
    LightLayers front;        ///< none: the view shows no blended surfaces
    LightLayers behindGlass;  ///< of those behind the nearest glass; none: the view shows no glass
    gpu::Image depth;         ///< of the nearest layer, as is the motion
    gpu::Image motion;
};

/// seen: the opaque surfaces, with the screen that reflections read. layers: also the parts of the light, not only the
/// sum.
BlendedSurfaces lightBlended(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                             bool layers);

/// `behind` with the blended surfaces in front of it, in another image; `behind` itself if there are none.
gpu::Image withBlended(gpu::PassList& f, gpu::Image front, gpu::Image behind);
LightLayers withBlended(gpu::PassList& f, const LightLayers& front, const LightLayers& behind);
/// They cover the background, too.
lighting::Light withBlended(gpu::PassList& f, const LightLayers& front, const lighting::Light& behind);

}  // namespace reflet
