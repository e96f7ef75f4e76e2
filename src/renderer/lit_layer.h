// Lights a layer of translucent surfaces like the opaque ones, by the same passes.
#pragma once

#include "effects/composite/composite.h"
#include "renderer/trace_lobe.h"

namespace reflet {

/// Settings for layers: they have no history, and no depth pyramid for contact shadows.
Settings layerSettings(Settings settings);

/// layer: with the G-buffer of the layer; its direct light is set. Its rays are traced in the screen of the opaque
/// surfaces.
Composite lightLayer(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, TracedView& layer, bool layers);

/// The same, with the direct light that the layer has.
Composite reflectedLight(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, const TracedView& layer,
                         bool layers);

}  // namespace reflet
