// Records the clear coats of a view.
#include "renderer/coat/coat.h"

#include "gpu/context.h"
#include "renderer/glass/glass.h"
#include "renderer/lit_layer.h"
#include "renderer/sub_views.h"

namespace reflet {

namespace {

// Whether the view may show coats of opaque surfaces.
bool showsCoats(const ViewInputs& in, const Settings& settings) {
    const bool glass = drawsGlass(in.draws, settings.transmission, settings.materials);
    const auto keep = [&](const Draw& draw) {
        return draw.coated && draw.alpha >= opaqueAlpha && !(draw.glass && glass);
    };
    return in.draws.coated && settings.materials.coats != 0 && settings.materials.lambertOnly == 0 &&
           anyDraws(in.draws, {.keep = keep, .worldToClip = in.view.worldToClip});
}

GBufferContent contentOf(const ViewInputs& in, const Settings& settings, const CoatedSurfaces& surfaces) {
    GBufferContent content{
        .clipPlane = in.clipPlane, .opaqueDepth = surfaces.depth, .nearerDepth = surfaces.nearerDepth};
    content.coat = true;
    content.glass = surfaces.kind == CoatedSurfaces::Kind::glass;
    content.blendedCoats = surfaces.kind == CoatedSurfaces::Kind::blended;
    content.withoutGlass = drawsGlass(in.draws, settings.transmission, settings.materials);
    return content;
}

gpu::Image coatOver(gpu::PassList& f, const ViewInputs& in, const GBuffer& g, gpu::Image layer, gpu::Image behind) {
    const gpu::Image over = f.image("lit.coat", VK_FORMAT_R16G16B16A16_SFLOAT, g.depth.size);
    gpu::ComputePass pass = f.compute("coat_over", "coat_over.comp");
    bindSurfaces(f, pass, g)
        .read("depth", g.depth)
        .read("normal", g.normal)
        .read("material", g.material)
        .read("motion", g.motion)
        .read("ggxTable", in.ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .read("layer", layer)
        .read("behind", behind)
        .write("over", over)
        .params(CoatOverParams{in.view})
        .dispatch(over.size);
    return over;
}

}  // namespace

bool coatsGlass(const DrawList& list, const Settings& settings) {
    return list.coatedGlass && settings.materials.coats != 0;
}

LightLayers addCoats(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                     const CoatedSurfaces& surfaces, const LightLayers& behind) {
    const auto scope = f.scope("coat");
    const Settings ofCoat = coatSettings(settings);
    TracedView coats = seen;
    coats.images.ambientOcclusion = {};
    coats.images.g = drawGBuffer(f, in.draws, in.view, ofCoat.materials, contentOf(in, ofCoat, surfaces));
    coats.images.direct = directLightOn(f, in, ofCoat, coats.images).all;  // a coat is in the shadows of its surface
    const bool layers = bool(behind.indirectDiffuse);
    const LightLayers light = reflectedLight(f, in, ofCoat, coats, layers);
    const GBuffer& g = coats.images.g;
    LightLayers out = behind;
    out.lit = coatOver(f, in, g, light.lit, behind.lit);
    if (layers) {
        out.direct = coatOver(f, in, g, light.direct, behind.direct);
        out.indirectDiffuse = coatOver(f, in, g, light.indirectDiffuse, behind.indirectDiffuse);
        out.indirectSpecular = coatOver(f, in, g, light.indirectSpecular, behind.indirectSpecular);
    }
    return out;
}

LightLayers withCoats(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                      const LightLayers& behind) {
    return showsCoats(in, settings) ? addCoats(f, in, settings, seen, {seen.images.drawnDepth}, behind) : behind;
}

lighting::Light withCoats(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                          const lighting::Light& behind) {
    lighting::Light out = behind;
    static_cast<LightLayers&>(out) = withCoats(f, in, settings, seen, static_cast<const LightLayers&>(behind));
    return out;
}

}  // namespace reflet
