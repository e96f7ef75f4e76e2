// Records the layers of blended surfaces.
#include "renderer/blend/blend_layers.h"

#include "renderer/coat/coat.h"
#include "renderer/glass/glass_layers.h"
#include "renderer/lit_layer.h"
#include "renderer/sub_views.h"

namespace reflet {

namespace {

constexpr VkFormat lightFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

// The light of a layer with its clear coats.
LightLayers litLayer(gpu::PassList& f, const ViewInputs& in, const Settings& settings, TracedView& layer,
                     gpu::Image nearerDepth, bool layers) {
    const LightLayers lit = lightLayer(f, in, settings, layer, layers);
    if (!in.draws.coatedBlended || settings.materials.coats == 0 || settings.materials.lambertOnly != 0) {
        return lit;
    }
    return addCoats(f, in, settings, layer, {layer.images.g.depth, nearerDepth, CoatedSurfaces::Kind::blended}, lit);
}

LightLayers imagesOf(gpu::PassList& f, uvec2 size, bool layers) {
    LightLayers sums;
    sums.lit = f.image("blended", lightFormat, size);
    if (layers) {
        sums.direct = f.image("blended_direct", lightFormat, size);
        sums.indirectDiffuse = f.image("blended_diffuse", lightFormat, size);
        sums.indirectSpecular = f.image("blended_specular", lightFormat, size);
    }
    return sums;
}

void addLayer(gpu::PassList& f, const LightLayers& to, const LightLayers& lit, const BlendedLayer& layer,
              BlendSide side) {
    blendLayer(f, to.lit, lit.lit, layer, side);
    if (to.direct) {
        blendLayer(f, to.direct, lit.direct, layer, side);
        blendLayer(f, to.indirectDiffuse, lit.indirectDiffuse, layer, side);
        blendLayer(f, to.indirectSpecular, lit.indirectSpecular, layer, side);
    }
}

}  // namespace

BlendedSurfaces lightBlended(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                             bool layers) {
    if (settings.blend.layers == 0 || !showsBlended(in.draws, in.view)) {
        return {};
    }
    const gpu::Image glassDepth = nearestGlass(f, in, settings, seen.images.g.depth);
    const auto scope = f.scope("blend");
    const Settings ofLayer = layerSettings(settings);
    const uvec2 size = seen.images.g.depth.size;
    BlendedSurfaces out{imagesOf(f, size, layers), glassDepth ? imagesOf(f, size, layers) : LightLayers{}, {}, {}};
    gpu::Image nearer;
    for (uint32_t i = 0; i < settings.blend.layers; ++i) {
        TracedView layer{seen.images, seen.screen, {}};
        layer.images.ambientOcclusion = {};
        const GBufferContent content{
            .clipPlane = in.clipPlane, .opaqueDepth = seen.images.g.depth, .nearerDepth = nearer};
        layer.images.g = drawGBuffer(f, in.draws, in.view, settings.materials, content);
        const LightLayers lit = litLayer(f, in, ofLayer, layer, nearer, layers);
        nearer = layer.images.g.depth;
        out.depth = i == 0 ? nearer : out.depth;
        out.motion = i == 0 ? layer.images.g.motion : out.motion;
        const BlendedLayer blended{nearer, layer.images.g.motion, glassDepth, i == 0};
        addLayer(f, out.front, lit, blended, glassDepth ? BlendSide::beforeGlass : BlendSide::all);
        if (glassDepth) {
            addLayer(f, out.behindGlass, lit, blended, BlendSide::behindGlass);
        }
    }
    return out;
}

gpu::Image withBlended(gpu::PassList& f, gpu::Image front, gpu::Image behind) {
    if (!front) {
        return behind;
    }
    const gpu::Image over = f.image("lit.blended", lightFormat, behind.size);
    blendOver(f, front, behind, over);
    return over;
}

LightLayers withBlended(gpu::PassList& f, const LightLayers& front, const LightLayers& behind) {
    return {withBlended(f, front.direct, behind.direct), withBlended(f, front.indirectDiffuse, behind.indirectDiffuse),
            withBlended(f, front.indirectSpecular, behind.indirectSpecular), withBlended(f, front.lit, behind.lit)};
}

lighting::Light withBlended(gpu::PassList& f, const LightLayers& front, const lighting::Light& behind) {
    if (!front.lit) {
        return behind;
    }
    lighting::Light out = behind;
    static_cast<LightLayers&>(out) = withBlended(f, front, static_cast<const LightLayers&>(behind));
    if (behind.coverage) {
        out.coverage = f.image("coverage.blended", lightFormat, behind.coverage.size);
        coverOver(f, front.lit, behind.coverage, out.coverage);
    } else {
        out.translucent.push_back(front.lit);
    }
    return out;
}

}  // namespace reflet
