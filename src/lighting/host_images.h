// Images of a host with conventions of its own, turned into those that the stages read.
#pragma once

#include "effects/import/import.h"
#include "effects/rescale/rescale.h"
#include "lighting/surfaces.h"

namespace reflet::lighting {

/// The G-buffer and the second depth layer of a host. params: without the channels, which are set.
Surfaces importSurfaces(gpu::PassList& f, const HostSurfaces& host, const ImportParams& params);

/// RGBA16F of the same size: finite, 0 to 65504.
gpu::Image importLight(gpu::PassList& f, gpu::Image light, const LightImport& how = {});

/// How bright a host's light may be in this frame, by what it was in the last ones.
LightBound boundLight(gpu::PassList& f, LightBoundStore& own, uvec2 size, const LightBoundFrame& frame);

/// Notes light that the limits have bounded, for those of the next frame.
void measureLight(gpu::PassList& f, LightBound& bound, gpu::Image light);

/// What keeps histories when the size of the frames changes: for gpu::FrameSizes.
using reflet::rescaledFormats;
using reflet::rescaleHistory;

}  // namespace reflet::lighting
