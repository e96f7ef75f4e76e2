// Coloured sun shadows of blended surfaces: transmittance by separate shadow maps. Shared by C++ and GLSL.
//
// The sun's shadow map has only opaque surfaces. The two blended surfaces nearest to the sun have a map each, with
// depth and transmittance (as in colored stochastic and deep shadow maps, but with two fixed layers; T. Lokovic,
// E. Veach, Deep Shadow Maps, 2000), found by depth peeling. Edges are as sharp as the map: there is no penumbra.
#ifndef REFLET_RENDERER_BLEND_SHADOW_H
#define REFLET_RENDERER_BLEND_SHADOW_H

#include "base/shared.h"
#include "effects/shadow/shadow.h"

SHARED_BEGIN

const uint blendShadowLayers = 2;

struct BlendShadowParams {
    ViewParams view;
    SunShadowParams sun;
    uint resolution;  // texels along each side of a cascade's tile
    float bias;       // as in ShadowSettings
};

SHARED_END

#ifdef __cplusplus

#include "renderer/draw_list.h"

#include <array>

namespace reflet {

/// A layer, of the size of the sun's shadow map.
struct BlendShadowMap {
    gpu::Image depth;          ///< D32, reversed; 0: no surface
    gpu::Image transmittance;  ///< RGBA16F: share of the light that passes
    gpu::Image extinction;  ///< RGBA16F: behind it [1/m]; only the first layer's is read, where light enters a volume
};
using BlendShadowMaps = std::array<BlendShadowMap, blendShadowLayers>;

/// The images of BlendShadowMaps, kept from frame to frame.
struct BlendShadowStore {
    struct Layer {
        gpu::KeptImage depth{"blend_shadow_map.depth"};
        gpu::KeptImage transmittance{"blend_shadow_map.transmittance"};
        gpu::KeptImage extinction{"blend_shadow_map.extinction"};
    };
    std::array<Layer, blendShadowLayers> layers;
};

BlendShadowMaps drawBlendShadowMaps(gpu::PassList& f, BlendShadowStore& own, const DrawList& list,
                                    const SunShadowParams& sun, const ShadowSettings& settings);

/// RGBA8: the sun's visibility (R8) times the transmittance of the blended surfaces per colour.
gpu::Image blendShadow(gpu::PassList& f, const GBuffer& g, const BlendShadowMaps& maps, gpu::Image sunVisibility,
                       const BlendShadowParams& params);

}  // namespace reflet
#endif

#endif
