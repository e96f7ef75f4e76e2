// Lights a layer of translucent surfaces like the opaque ones, by the same passes, without history.
#pragma once

#include "renderer/trace_lobe.h"

namespace reflet {

/// Lights the surfaces in the G-buffer of `layer` and sets its direct light. Rays are traced through the depth buffer
/// of the opaque surfaces. layers: also returns the parts of the light.
LightLayers lightLayer(gpu::PassList& f, const ViewInputs& in, const Settings& settings, TracedView& layer,
                       bool layers);

/// The same for a layer whose direct light is already set.
LightLayers reflectedLight(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& layer,
                           bool layers);

}  // namespace reflet
