// Records the layers of blended surfaces.
#include "renderer/blend/blend_layers.h"

namespace reflet {

namespace {

// The light of a layer with its clear coats.
LightLayers litLayer(gpu::Recorder& f, BlendStore& own, BlendStore::Layer& store, const ViewInputs& in,
                     const Settings& settings, TracedView& layer, gpu::Image nearerDepth, bool layers) {
    const Composite light = lightLayer(f, store, in, settings, layer, layers);
    const LightLayers lit{layer.images.direct, light};
    if (!in.draws.coatedBlended || settings.materials.coats == 0 || settings.materials.lambertOnly != 0) {
        return lit;
    }
    const CoatedSurfaces surfaces{layer.images.g.depth, nearerDepth, CoatedSurfaces::Kind::blended};
    return addCoats(f, own.coat, in, settings, layer, surfaces, lit, {}, layers);
}

}  // namespace

BlendedLight lightBlended(gpu::Recorder& f, BlendStore& own, const ViewInputs& in, const Settings& asked,
                          const TracedView& seen, bool layers) {
    BlendedLight out;
    if (asked.blend.layers == 0 || !showsBlended(in.draws, in.view)) {
        return out;
    }
    const auto scope = f.scope("blend");
    const Settings settings = layerSettings(asked);
    const auto sum = [&](gpu::KeptImage& image) {
        return image.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, seen.images.g.depth.size);
    };
    out.lit = sum(own.lit);
    if (layers) {
        out = {out.lit, sum(own.direct), sum(own.indirectDiffuse), sum(own.indirectSpecular)};
    }
    gpu::Image nearer;
    for (uint32_t i = 0; i < settings.blend.layers; ++i) {
        BlendStore::Layer& store = own.layers[i % own.layers.size()];
        TracedView layer{seen.images, seen.screen, {}};
        layer.images.ambientOcclusion = {};
        const GBufferContent content{
            .clipPlane = in.clipPlane, .opaqueDepth = seen.images.g.depth, .nearerDepth = nearer};
        layer.images.g = drawGBuffer(f, store.g, in.draws, in.view, settings.materials, content);
        const LightLayers lit = litLayer(f, own, store, in, settings, layer, nearer, layers);
        nearer = layer.images.g.depth;
        const gpu::Image alpha = layer.images.g.motion;
        blendLayer(f, out.lit, lit.light.lit, alpha, i == 0);
        if (layers) {
            blendLayer(f, out.direct, lit.direct, alpha, i == 0);
            blendLayer(f, out.indirectDiffuse, lit.light.indirectDiffuse, alpha, i == 0);
            blendLayer(f, out.indirectSpecular, lit.light.indirectSpecular, alpha, i == 0);
        }
    }
    return out;
}

}  // namespace reflet
