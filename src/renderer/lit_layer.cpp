// Records the light of a layer.
#include "renderer/lit_layer.h"

#include "lighting/picture.h"

namespace reflet {

LightLayers lightLayer(gpu::PassList& f, const ViewInputs& in, const Settings& settings, TracedView& layer,
                       bool layers) {
    lightSurfaces(f, nullptr, in, settings, layer.images);
    return reflectedLight(f, in, settings, layer, layers);
}

LightLayers reflectedLight(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& layer,
                           bool layers) {
    const LobeLight diffuse = traceLobe(f, nullptr, in, settings, layer, lobeDiffuse);
    const LobeLight specular = traceLobe(f, nullptr, in, settings, layer, lobeSpecular);
    return lighting::compose(f, contextOf(in, settings), settings, layer.images,
                             {layer.images.direct, diffuse, specular}, layers);
}

}  // namespace reflet
