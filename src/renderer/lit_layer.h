// Lights a layer of translucent surfaces like the opaque ones, by the same passes, without history.
#pragma once

#include "renderer/trace_lobe.h"

namespace reflet {

/// layer: with the G-buffer of the layer; its direct light is set. Its rays are traced in the screen of the opaque
/// surfaces. layers: the parts of the light, too.
LightLayers lightLayer(gpu::PassList& f, const ViewInputs& in, const Settings& settings, TracedView& layer,
                       bool layers);

/// The same, with the direct light that the layer has.
LightLayers reflectedLight(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& layer,
                           bool layers);

}  // namespace reflet
