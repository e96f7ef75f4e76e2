// The transmissive surfaces of a view, composited over the light behind them.
#pragma once

#include "effects/accumulate/accumulate.h"
#include "renderer/coat/coat.h"
#include "renderer/glass/glass.h"
#include "renderer/lit_layer.h"

#include <array>

namespace reflet {

/// Owns the images of the layers of glass in front of a view.
struct GlassStore {
    struct Sum {
        gpu::KeptImage lit{"glass.lit"};
        gpu::KeptImage direct{"glass.direct"};
        gpu::KeptImage diffuse{"glass.indirect_diffuse"};
        gpu::KeptImage specular{"glass.indirect_specular"};
    };
    std::array<GBufferStore, mostGlassLayers> g;
    LitLayerStore light;
    CoatStore coat;
    GlassSurfacesStore surfaces;
    gpu::KeptImage lightMips{"glass.light_mips"};
    std::array<Sum, 2> sums;  ///< used in turn: a layer is composited over the sum before
    gpu::KeptImage depth{"glass.depth"};
    gpu::KeptImage followedDepth{"glass.followed_depth"};
    gpu::KeptImage followedMotion{"glass.followed_motion"};
};

/// Whether the view may show glass.
bool showsGlass(const ViewInputs& in, const Settings& settings);

/// Composites the glass over `behind`, the light of the view's opaque surfaces, back to front: nearer glass refracts
/// what is farther. Transmitted light counts as indirect specular. lit: the sum is written to it. layers: also those of
/// `behind`, not only the sum.
LightLayers throughGlass(gpu::Recorder& f, GlassStore& own, const ViewInputs& in, const Settings& asked,
                         const TracedView& seen, const LightLayers& behind, gpu::Image lit, bool layers);

/// Depth of the nearest glass before throughGlass has drawn it; 0: none. D32.
gpu::Image nearestGlass(gpu::Recorder& f, GlassStore& own, const ViewInputs& in, const Settings& settings,
                        gpu::Image opaqueDepth);

/// Depth of the opaque surfaces, or of the glass of the last throughGlass where that is nearer: R32F.
gpu::Image depthWithGlass(gpu::Recorder& f, GlassStore& own, gpu::Image opaqueDepth);

/// g, of the opaque surfaces, with the depth (R32F) and motion of the volumes of glass in front, of the last
/// throughGlass.
GBuffer motionWithGlass(gpu::Recorder& f, GlassStore& own, GBuffer g);

}  // namespace reflet
