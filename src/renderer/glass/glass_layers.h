// The transmissive surfaces of a view, composited over the light behind them.
#pragma once

#include "effects/accumulate/accumulate.h"
#include "renderer/coat/coat.h"
#include "renderer/glass/glass.h"
#include "renderer/lit_layer.h"

namespace reflet {

/// Whether the view may show glass.
bool showsGlass(const ViewInputs& in, const Settings& settings);

/// The nearest layer of glass; none where a view shows no glass.
struct NearestGlass {
    gpu::Image depth;   ///< 0: none. D32
    gpu::Image motion;  ///< of its G-buffer
    gpu::Image tint;    ///< of its GlassSurfaces
};

struct LightThroughGlass {
    LightLayers light;
    NearestGlass nearest;
};

/// Composites the glass over `behind`, the light of the view's opaque surfaces, back to front: nearer glass refracts
/// what is farther. Transmitted light counts as indirect specular. lit: the sum is written to it; none: to an image of
/// this frame. layers: also those of `behind`, not only the sum.
LightThroughGlass throughGlass(gpu::Recorder& f, const ViewInputs& in, const Settings& asked, const TracedView& seen,
                               const LightLayers& behind, gpu::Image lit, bool layers);

/// Depth of the nearest glass before throughGlass has drawn it; 0: none. D32.
gpu::Image nearestGlass(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, gpu::Image opaqueDepth);

/// Depth of the opaque surfaces, or of the glass where that is nearer: R32F.
gpu::Image depthWithGlass(gpu::Recorder& f, const NearestGlass& nearest, gpu::Image opaqueDepth);

/// g, of the opaque surfaces, with the depth (R32F) and motion of the volumes of glass in front.
GBuffer motionWithGlass(gpu::Recorder& f, const NearestGlass& nearest, GBuffer g);

}  // namespace reflet
