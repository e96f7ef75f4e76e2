// Records the layers of blended surfaces.
#include "renderer/blend/blend_layers.h"

namespace reflet {

namespace {

// The light of a layer with its clear coats.
LightLayers litLayer(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, TracedView& layer,
                     gpu::Image nearerDepth, bool layers) {
    const Composite light = lightLayer(f, in, settings, layer, layers);
    const LightLayers lit{layer.images.direct, light};
    if (!in.draws.coatedBlended || settings.materials.coats == 0 || settings.materials.lambertOnly != 0) {
        return lit;
    }
    const CoatedSurfaces surfaces{layer.images.g.depth, nearerDepth, CoatedSurfaces::Kind::blended};
    return addCoats(f, in, settings, layer, surfaces, lit, {}, layers);
}

BlendedLight imagesOf(gpu::Recorder& f, uvec2 size, bool layers) {
    const auto sum = [&](const char* name) { return f.image(name, VK_FORMAT_R16G16B16A16_SFLOAT, size); };
    if (!layers) {
        return {sum("blended"), {}, {}, {}};
    }
    return {sum("blended"), sum("blended_direct"), sum("blended_diffuse"), sum("blended_specular")};
}

void addLayer(gpu::Recorder& f, const BlendedLight& to, const LightLayers& lit, const BlendedLayer& layer,
              BlendSide side) {
    blendLayer(f, to.lit, lit.light.lit, layer, side);
    if (to.direct) {
        blendLayer(f, to.direct, lit.direct, layer, side);
        blendLayer(f, to.indirectDiffuse, lit.light.indirectDiffuse, layer, side);
        blendLayer(f, to.indirectSpecular, lit.light.indirectSpecular, layer, side);
    }
}

}  // namespace

BlendedSurfaces lightBlended(gpu::Recorder& f, const ViewInputs& in, const Settings& asked, const TracedView& seen,
                             gpu::Image glassDepth, bool layers) {
    if (asked.blend.layers == 0 || !showsBlended(in.draws, in.view)) {
        return {};
    }
    const auto scope = f.scope("blend");
    const Settings settings = layerSettings(asked);
    const uvec2 size = seen.images.g.depth.size;
    const BlendedSurfaces out{imagesOf(f, size, layers), glassDepth ? imagesOf(f, size, layers) : BlendedLight{}};
    gpu::Image nearer;
    for (uint32_t i = 0; i < settings.blend.layers; ++i) {
        TracedView layer{seen.images, seen.screen, {}};
        layer.images.ambientOcclusion = {};
        const GBufferContent content{
            .clipPlane = in.clipPlane, .opaqueDepth = seen.images.g.depth, .nearerDepth = nearer};
        layer.images.g = drawGBuffer(f, in.draws, in.view, settings.materials, content);
        const LightLayers lit = litLayer(f, in, settings, layer, nearer, layers);
        nearer = layer.images.g.depth;
        const BlendedLayer blended{nearer, layer.images.g.motion, glassDepth, i == 0};
        addLayer(f, out.front, lit, blended, glassDepth ? BlendSide::beforeGlass : BlendSide::all);
        if (glassDepth) {
            addLayer(f, out.behindGlass, lit, blended, BlendSide::behindGlass);
        }
    }
    return out;
}

gpu::Image withBlended(gpu::Recorder& f, gpu::Image front, gpu::Image behind) {
    if (!front) {
        return behind;
    }
    const gpu::Image over = f.image("lit.blended", VK_FORMAT_R16G16B16A16_SFLOAT, behind.size);
    blendOver(f, front, behind, over);
    return over;
}

LightLayers withBlended(gpu::Recorder& f, const BlendedLight& front, const LightLayers& behind, gpu::Image lit) {
    if (!front.lit) {
        return behind;
    }
    LightLayers out = behind;
    if (lit) {
        blendOver(f, front.lit, behind.light.lit, lit);
        out.light.lit = lit;
    } else {
        out.light.lit = withBlended(f, front.lit, behind.light.lit);
    }
    out.direct = withBlended(f, front.direct, behind.direct);
    out.light.indirectDiffuse = withBlended(f, front.indirectDiffuse, behind.light.indirectDiffuse);
    out.light.indirectSpecular = withBlended(f, front.indirectSpecular, behind.light.indirectSpecular);
    return out;
}

}  // namespace reflet
