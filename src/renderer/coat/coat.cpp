// Records the clear coats of a view.
#include "renderer/coat/coat.h"

#include "renderer/glass/glass.h"

namespace reflet {

namespace {

Settings coatSettings(const Settings& asked) {
    Settings settings = layerSettings(asked);
    settings.diffuse.rays = 0;  // a coat has no diffuse base
    return settings;
}

// A coat is where its surface is, so it is in the same shadows.
gpu::Image directOnCoats(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, ViewImages coats) {
    if (settings.shadow.filter == ShadowFilter::traced && in.traced != nullptr) {
        lightSurfaces(f, nullptr, in, settings, coats);
        return coats.direct;
    }
    return directLight(f, coats.g, {coats.sunVisibility, coats.lampVisibility, coats.lampTiles.masks}, in.ggxTable,
                       {in.view, -in.sunDirection, in.sunIrradiance}, {in.lamps, in.environment, false});
}

}  // namespace

bool showsCoats(const ViewInputs& in, const Settings& settings) {
    const bool glass = drawsGlass(in.draws, settings.transmission, settings.materials);
    const auto keep = [&](const Draw& draw) {
        return draw.coated && draw.alpha >= opaqueAlpha && !(draw.glass && glass);
    };
    return in.draws.coated && settings.materials.coats != 0 && settings.materials.lambertOnly == 0 &&
           anyDraws(in.draws, {.keep = keep, .worldToClip = in.view.worldToClip});
}

bool coatsGlass(const DrawList& list, const Settings& settings) {
    return list.coatedGlass && settings.materials.coats != 0;
}

LightLayers addCoats(gpu::Recorder& f, const ViewInputs& in, const Settings& asked, const TracedView& seen,
                     const CoatedSurfaces& surfaces, const LightLayers& behind, gpu::Image lit, bool layers) {
    const auto scope = f.scope("coat");
    const Settings settings = coatSettings(asked);
    GBufferContent content{
        .clipPlane = in.clipPlane, .opaqueDepth = surfaces.depth, .nearerDepth = surfaces.nearerDepth};
    content.coat = true;
    content.glass = surfaces.kind == CoatedSurfaces::Kind::glass;
    content.blendedCoats = surfaces.kind == CoatedSurfaces::Kind::blended;
    content.withoutGlass = drawsGlass(in.draws, settings.transmission, settings.materials);
    TracedView coats = seen;
    coats.images.ambientOcclusion = {};
    coats.images.g = drawGBuffer(f, in.draws, in.view, settings.materials, content);
    const GBuffer& g = coats.images.g;
    coats.images.direct = directOnCoats(f, in, settings, coats.images);
    const Composite light = reflectedLight(f, in, settings, coats, layers);
    const auto over = [&](gpu::Image layer, gpu::Image under, gpu::Image given = {}) {
        const gpu::Image sum = given ? given : f.image("lit", VK_FORMAT_R16G16B16A16_SFLOAT, g.depth.size);
        gpu::Pass pass = f.compute("coat_over", "coat_over.comp");
        bindSurfaces(f, pass, g)
            .read("depth", g.depth)
            .read("normal", g.normal)
            .read("material", g.material)
            .read("motion", g.motion)
            .read("ggxTable", in.ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
            .read("layer", layer)
            .read("behind", under)
            .write("over", sum)
            .params(CoatOverParams{in.view})
            .dispatch(sum.size);
        return sum;
    };
    LightLayers out = behind;
    out.light.lit = over(light.lit, behind.light.lit, lit);
    if (layers) {
        out.direct = over(coats.images.direct, behind.direct);
        out.light.indirectDiffuse = over(light.indirectDiffuse, behind.light.indirectDiffuse);
        out.light.indirectSpecular = over(light.indirectSpecular, behind.light.indirectSpecular);
    }
    return out;
}

}  // namespace reflet
