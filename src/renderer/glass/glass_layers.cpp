// Records the layers of glass of a view.
#include "renderer/glass/glass_layers.h"

#include "effects/light_mips/light_mips.h"

#include <string>
#include <vector>

namespace reflet {

namespace {

Settings glassSettings(const Settings& asked, const DrawList& draws) {
    Settings settings = layerSettings(asked);
    settings.traceScreen.light = HitLight::lit;  // that of this frame, with the glass behind
    if (!draws.murky) {
        settings.diffuse.rays = 0;  // nothing reflects diffusely
    }
    return settings;
}

// The nearest layers, the nearest first.
std::vector<GBuffer> peelGlass(gpu::Recorder& f, const ViewInputs& in, const Settings& settings,
                               gpu::Image opaqueDepth) {
    std::vector<GBuffer> peeled;
    for (uint32_t i = 0; i < settings.transmission.layers; ++i) {
        const GBufferContent content{.clipPlane = in.clipPlane,
                                     .opaqueDepth = opaqueDepth,
                                     .nearerDepth = i > 0 ? peeled.back().depth : gpu::Image{},
                                     .glass = true};
        peeled.push_back(drawGBuffer(f, in.draws, in.view, settings.materials, content));
    }
    return peeled;
}

// seen: with the layer's G-buffer, and the light behind it on screen. nearerDepth: of the layer in front, if any. last:
// gets the sum, if given.
LightThroughGlass addLayer(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, TracedView seen,
                           gpu::Image nearerDepth, const LightLayers& behind, gpu::Image last) {
    const bool layers = bool(behind.light.indirectDiffuse);
    const GBuffer& g = seen.images.g;
    const Composite lit = lightLayer(f, in, settings, seen, layers);
    if (in.draws.frosted) {
        seen.screen.lightMips = makeLightMips(f, behind.light.lit);
    }
    const GlassSurfaces made = glassSurfaces(f, in.draws, in.view, g);
    RefractedRays refracted = refractRays(f, g, made, in.ggxTable, in.draws.dispersive,
                                          {in.view, settings.transmission.exitSteps, in.draws.frosted ? 1U : 0U});
    answerRays(f, refracted.rays, in, settings, seen);
    const auto over = [&](gpu::Image layer, const RefractedRays* rays, gpu::Image under, gpu::Image given = {}) {
        const gpu::Image sum = given ? given : f.image("lit", VK_FORMAT_R16G16B16A16_SFLOAT, g.depth.size);
        glassOver(f, g, layer, rays, under, sum);
        return sum;
    };
    const bool coats = coatsGlass(in.draws, settings);
    LightLayers out = behind;
    out.light.lit = over(lit.lit, &refracted, behind.light.lit, coats ? gpu::Image{} : last);
    if (layers) {
        out.direct = over(seen.images.direct, nullptr, behind.direct);
        out.light.indirectDiffuse = over(lit.indirectDiffuse, nullptr, behind.light.indirectDiffuse);
        out.light.indirectSpecular = over(lit.indirectSpecular, &refracted, behind.light.indirectSpecular);
    }
    if (coats) {
        const CoatedSurfaces surfaces{g.depth, nearerDepth, CoatedSurfaces::Kind::glass};
        out = addCoats(f, in, settings, seen, surfaces, out, last, layers);
    }
    return {out, {g.depth, g.motion, made.tint}};
}

}  // namespace

bool showsGlass(const ViewInputs& in, const Settings& settings) {
    return drawsGlass(in.draws, settings.transmission, settings.materials) &&
           anyDraws(in.draws,
                    {.keep = [](const Draw& draw) { return draw.glass; }, .worldToClip = in.view.worldToClip});
}

LightThroughGlass throughGlass(gpu::Recorder& f, const ViewInputs& in, const Settings& asked, const TracedView& seen,
                               const LightLayers& behind, gpu::Image lit, bool layers) {
    const auto scope = f.scope("glass");
    const Settings settings = glassSettings(asked, in.draws);
    const std::vector<GBuffer> peeled = peelGlass(f, in, settings, seen.images.g.depth);
    LightThroughGlass sum{behind, {}};
    if (!layers) {
        sum.light.light.indirectDiffuse = {};
        sum.light.light.indirectSpecular = {};
    }
    for (size_t i = peeled.size(); i-- > 0;) {
        const auto layerScope = f.scope(std::to_string(i));
        TracedView layer{seen.images, seen.screen, {}};
        layer.images.g = peeled[i];
        layer.images.ambientOcclusion = {};
        layer.screen.light = sum.light.light.lit;
        layer.screen.lit = {};
        layer.screen.lightMips = {};
        sum = addLayer(f, in, settings, layer, i > 0 ? peeled[i - 1].depth : gpu::Image{}, sum.light,
                       i == 0 ? lit : gpu::Image{});
    }
    return sum;
}

gpu::Image nearestGlass(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, gpu::Image opaqueDepth) {
    const auto scope = f.scope("glass");
    const GBufferContent content{.clipPlane = in.clipPlane, .opaqueDepth = opaqueDepth, .glass = true};
    return drawGBuffer(f, in.draws, in.view, settings.materials, content).depth;
}

gpu::Image depthWithGlass(gpu::Recorder& f, const NearestGlass& nearest, gpu::Image opaqueDepth) {
    const gpu::Image depth = f.image("glass.depth", VK_FORMAT_R32_SFLOAT, opaqueDepth.size);
    f.compute("glass_depth", "glass_depth.comp")
        .read("opaque", opaqueDepth)
        .read("layer", nearest.depth)
        .write("nearest", depth)
        .params(GlassOverParams{depth.size})
        .dispatch(depth.size);
    return depth;
}

GBuffer motionWithGlass(gpu::Recorder& f, const NearestGlass& nearest, GBuffer g) {
    const gpu::Image depth = f.image("glass.followed_depth", VK_FORMAT_R32_SFLOAT, g.depth.size);
    const gpu::Image motion = f.image("glass.followed_motion", VK_FORMAT_R16G16B16A16_SFLOAT, g.depth.size);
    f.compute("glass_motion", "glass_motion.comp")
        .read("depth", g.depth)
        .read("motion", g.motion)
        .read("layerDepth", nearest.depth)
        .read("layerMotion", nearest.motion)
        .read("tint", nearest.tint)
        .write("followedDepth", depth)
        .write("followedMotion", motion)
        .params(GlassOverParams{depth.size})
        .dispatch(depth.size);
    g.depth = depth;
    g.motion = motion;
    return g;
}

}  // namespace reflet
