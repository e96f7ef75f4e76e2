// Records the light of a layer.
#include "renderer/lit_layer.h"

namespace reflet {

Settings layerSettings(Settings settings) {
    settings.contact.distance = 0.0F;
    settings.diffuse.method = DiffuseMethod::rays;  // slices start in the view that they walk through
    settings.shadow.history = 0;
    settings.denoise.history = 0;
    settings.traceScreen.countSteps = 0;
    return settings;
}

Composite lightLayer(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, TracedView& layer, bool layers) {
    lightSurfaces(f, nullptr, in, settings, layer.images);
    return reflectedLight(f, in, settings, layer, layers);
}

Composite reflectedLight(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, const TracedView& layer,
                         bool layers) {
    const LobeLight diffuse = traceLobe(f, nullptr, in, settings, layer, lobeDiffuse);
    const LobeLight specular = traceLobe(f, nullptr, in, settings, layer, lobeSpecular);
    const CompositeInputs parts{layer.images.g, layer.images.direct, diffuse,
                                specular,       in.ggxTable,         settings.materials.lambertOnly != 0,
                                layers};
    const gpu::Image lit = f.image("lit", VK_FORMAT_R16G16B16A16_SFLOAT, layer.images.g.depth.size);
    return composite(f, parts, lit, {in.view, settings.diffuse.gain});
}

}  // namespace reflet
