// The layers of blended surfaces in a view: peeled, lit and summed up.
#pragma once

#include "renderer/blend/blend.h"
#include "renderer/coat/coat.h"
#include "renderer/gbuffer/draw_gbuffer.h"
#include "renderer/lit_layer.h"

#include <array>

namespace reflet {

/// Owns the images of the layers of blended surfaces in front of a view.
struct BlendStore {
    struct Layer : LitLayerStore {
        GBufferStore g;
    };
    std::array<Layer, 2> layers;  ///< used in turn: a layer is peeled by the depth of the one before
    CoatStore coat;
    gpu::KeptImage lit{"blended"};
    gpu::KeptImage direct{"blended_direct"};
    gpu::KeptImage indirectDiffuse{"blended_diffuse"};
    gpu::KeptImage indirectSpecular{"blended_specular"};
};

/// Light of blended surfaces, and in alpha what they let through of the light behind. RGBA16F.
struct BlendedLight {
    gpu::Image lit;  ///< none: the view shows no blended surfaces
    gpu::Image direct;
    gpu::Image indirectDiffuse;
    gpu::Image indirectSpecular;
};

/// seen: the opaque surfaces, with the screen that reflections read. layers: also the parts of the light, not only lit.
BlendedLight lightBlended(gpu::Recorder& f, BlendStore& own, const ViewInputs& in, const Settings& asked,
                          const TracedView& seen, bool layers);

}  // namespace reflet
