// Records the light that surfaces transmit diffusely.
#include "renderer/other_side/other_side.h"

#include "renderer/glass/glass.h"
#include "renderer/lit_layer.h"
#include "renderer/sub_views.h"

namespace reflet {

namespace {

bool showsOtherSide(const ViewInputs& in, const Settings& settings) {
    const bool glass = drawsGlass(in.draws, settings.transmission, settings.materials);
    const auto keep = [&](const Draw& draw) {
        return draw.diffuseTransmission && draw.alpha >= opaqueAlpha && !(draw.glass && glass);
    };
    return in.draws.diffuseTransmission && settings.materials.lambertOnly == 0 &&
           anyDraws(in.draws, {.keep = keep, .worldToClip = in.view.worldToClip});
}

gpu::Image sumOf(gpu::PassList& f, const GBuffer& g, gpu::Image layer, gpu::Image light) {
    const gpu::Image sum = f.image("lit.other_side", VK_FORMAT_R16G16B16A16_SFLOAT, g.depth.size);
    f.compute("other_side", "other_side.comp")
        .read("depth", g.depth)
        .read("layer", layer)
        .read("light", light)
        .write("sum", sum)
        .params(OtherSideParams{sum.size})
        .dispatch(sum.size);
    return sum;
}

}  // namespace

LightLayers withOtherSide(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                          const LightLayers& light) {
    if (!showsOtherSide(in, settings)) {
        return light;
    }
    const auto scope = f.scope("other_side");
    const Settings ofLayer = otherSideSettings(settings);
    TracedView layer = seen;
    layer.images.ambientOcclusion = {};
    GBufferContent content{.clipPlane = in.clipPlane, .opaqueDepth = seen.images.drawnDepth};
    content.otherSide = true;
    content.withoutGlass = drawsGlass(in.draws, settings.transmission, settings.materials);
    layer.images.g = drawGBuffer(f, in.draws, in.view, ofLayer.materials, content);
    const bool layers = bool(light.indirectDiffuse);
    const LightLayers lit = lightLayer(f, in, ofLayer, layer, layers);
    const GBuffer& g = layer.images.g;
    LightLayers out = light;
    out.lit = sumOf(f, g, lit.lit, light.lit);
    if (layers) {
        out.direct = sumOf(f, g, layer.images.direct, light.direct);
        out.indirectDiffuse = sumOf(f, g, lit.indirectDiffuse, light.indirectDiffuse);
    }
    return out;
}

lighting::Light withOtherSide(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                              const lighting::Light& light) {
    lighting::Light out = light;
    static_cast<LightLayers&>(out) = withOtherSide(f, in, settings, seen, static_cast<const LightLayers&>(light));
    return out;
}

}  // namespace reflet
