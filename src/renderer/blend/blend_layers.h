// The layers of blended surfaces in a view: peeled, lit and summed up.
#pragma once

#include "renderer/blend/blend.h"
#include "renderer/coat/coat.h"
#include "renderer/gbuffer/draw_gbuffer.h"
#include "renderer/lit_layer.h"

#include <array>

namespace reflet {

/// Owns the images of BlendedLight.
struct BlendedLightStore {
    gpu::KeptImage lit{"blended"};
    gpu::KeptImage direct{"blended_direct"};
    gpu::KeptImage indirectDiffuse{"blended_diffuse"};
    gpu::KeptImage indirectSpecular{"blended_specular"};
};

/// Owns the images of the layers of blended surfaces in front of a view.
struct BlendStore {
    struct Layer : LitLayerStore {
        GBufferStore g;
    };
    std::array<Layer, 2> layers;  ///< used in turn: a layer is peeled by the depth of the one before
    CoatStore coat;
    BlendedLightStore front;
    BlendedLightStore behindGlass;
};

/// Light of blended surfaces, and in alpha what they let through of the light behind. RGBA16F.
struct BlendedLight {
    gpu::Image lit;  ///< none: the view shows no blended surfaces
    gpu::Image direct;
    gpu::Image indirectDiffuse;
    gpu::Image indirectSpecular;
};

struct BlendedSurfaces {
    BlendedLight front;
    BlendedLight behindGlass;  ///< those behind the nearest glass; none: the view shows no glass
};

/// seen: the opaque surfaces, with the screen that reflections read. glassDepth: of the nearest glass, or none. layers:
/// also the parts of the light, not only lit.
BlendedSurfaces lightBlended(gpu::Recorder& f, BlendStore& own, const ViewInputs& in, const Settings& asked,
                             const TracedView& seen, gpu::Image glassDepth, bool layers);

/// Owns the images of withBlended.
struct WithBlendedStore {
    gpu::KeptImage lit{"lit.blended"};
    gpu::KeptImage direct{"direct.blended"};
    gpu::KeptImage indirectDiffuse{"indirect_diffuse.blended"};
    gpu::KeptImage indirectSpecular{"indirect_specular.blended"};
};

/// `behind` with the blended surfaces in front of it, in another image; `behind` itself if there are none.
gpu::Image withBlended(gpu::Recorder& f, gpu::KeptImage& own, gpu::Image front, gpu::Image behind);

/// The same for the light and its layers. lit: the image of the sum; none: one of the store.
LightLayers withBlended(gpu::Recorder& f, WithBlendedStore& own, const BlendedLight& front, const LightLayers& behind,
                        gpu::Image lit = {});

}  // namespace reflet
