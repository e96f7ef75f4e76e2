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
    gpu::Image motion;  ///< motion of its G-buffer
    gpu::Image tint;    ///< as in GlassSurfaces
};

struct LightThroughGlass {
    LightLayers light;
    NearestGlass nearest;
};

/// Composites the glass over `behind`, the light of the view's opaque surfaces including any layers that it has, back
/// to front: nearer glass refracts farther glass. Transmitted light counts as indirect specular. Returns `behind`
/// itself if the view shows no glass. opaque: the part of `behind` from opaque surfaces only, which paths through glass
/// read on the screen, as they hit blended surfaces by themselves; none: all of it.
LightThroughGlass throughGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                               const LightLayers& behind, gpu::Image opaque = {});

/// The same, and sets the depth of the nearest glass. In volumes of glass, the light is reprojected by their depth and
/// motion.
lighting::Light throughGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                             const lighting::Light& behind, gpu::Image opaque = {});

/// Draws the depth of the nearest glass, for use before throughGlass(): D32; 0: none. No image if the view shows no
/// glass.
gpu::Image nearestGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings, gpu::Image opaqueDepth);

}  // namespace reflet
