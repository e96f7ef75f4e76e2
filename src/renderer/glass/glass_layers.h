// The transmissive surfaces of a view, composited over the light behind them.
#pragma once

#include "lighting/light.h"
#include "renderer/glass/glass.h"
#include "renderer/trace_lobe.h"

namespace reflet {

/// Whether the view may show glass.
bool showsGlass(const ViewInputs& in, const Settings& settings);

/// The nearest layer of glass.
struct NearestGlass {
    gpu::Image depth;   ///< D32; 0: none. No image: the view shows no glass
    gpu::Image motion;  ///< of its G-buffer
    gpu::Image tint;    ///< of its GlassSurfaces
};

struct LightThroughGlass {
    LightLayers light;
    NearestGlass nearest;
};

/// Composites the glass over `behind`, the light of the view's opaque surfaces with those of its layers that it has,
/// back to front: nearer glass refracts what is farther. Transmitted light counts as indirect specular. `behind` itself
/// if the view shows no glass. opaque: what of `behind` is of opaque surfaces alone, which paths through glass read on
/// the screen, as they meet blended surfaces by themselves; none: all of it.
LightThroughGlass throughGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                               const LightLayers& behind, gpu::Image opaque = {});

/// The same, with the depth of the nearest glass, and with depth and motion of volumes of glass, which the light then
/// moves with.
lighting::Light throughGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                             const lighting::Light& behind, gpu::Image opaque = {});

/// Depth of the nearest glass before throughGlass has drawn it; 0: none. D32. None if the view shows no glass.
gpu::Image nearestGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings, gpu::Image opaqueDepth);

}  // namespace reflet
