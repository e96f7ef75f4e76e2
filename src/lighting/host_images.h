// Converts a host's images from its own conventions to those of the stages.
#pragma once

#include "effects/import/import.h"
#include "effects/rescale/rescale.h"
#include "lighting/surfaces.h"

namespace reflet::lighting {

/// The G-buffer and the second depth layer of a host. params: all but the channels, which this sets.
Surfaces importSurfaces(gpu::PassList& f, const HostSurfaces& host, const ImportParams& params);

/// Converts a host's light to RGBA16F of the same size: finite, 0 to 65504.
gpu::Image importLight(gpu::PassList& f, gpu::Image light, const LightImport& how = {});

/// Upper bounds of a host's light in this frame, from the light of the last ones.
LightBound boundLight(gpu::PassList& f, LightBoundStore& own, uvec2 size, const LightBoundFrame& frame);

/// Measures bounded light, for the bounds of the next frame.
void measureLight(gpu::PassList& f, LightBound& bound, gpu::Image light);

/// Resampling of histories when the frame size changes: for gpu::FrameSizes.
using reflet::rescaledFormats;
using reflet::rescaleHistory;

}  // namespace reflet::lighting
