// Records the layers of glass of a view.
#include "renderer/glass/glass_layers.h"

#include "lighting/indirect.h"
#include "renderer/coat/coat.h"
#include "renderer/lit_layer.h"
#include "renderer/scene_source.h"
#include "renderer/sub_views.h"

#include <cmath>
#include <string>
#include <vector>

namespace reflet {

namespace {

// Whose back faces are layers, too.
std::optional<uint32_t> mediumDraw(const ViewInputs& in) {
    return in.medium ? std::optional(in.medium->draw) : std::nullopt;
}

// The nearest layers, the nearest first.
std::vector<GBuffer> peelGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings,
                               gpu::Image opaqueDepth) {
    std::vector<GBuffer> peeled;
    // Paths find the layers behind the first.
    const uint32_t layers = refractsPaths(settings, in) ? 1 : settings.transmission.layers;
    for (uint32_t i = 0; i < layers; ++i) {
        const GBufferContent content{.clipPlane = in.clipPlane,
                                     .opaqueDepth = opaqueDepth,
                                     .nearerDepth = i > 0 ? peeled.back().depth : gpu::Image{},
                                     .glass = true,
                                     .bothSides = mediumDraw(in)};
        peeled.push_back(drawGBuffer(f, in.draws, in.view, settings.materials, content));
    }
    return peeled;
}

gpu::Image glassOver(gpu::PassList& f, const GBuffer& g, gpu::Image layer, const RefractedRays* transmitted,
                     gpu::Image behind) {
    const gpu::Image over = f.image("lit.glass", VK_FORMAT_R16G16B16A16_SFLOAT, g.depth.size);
    glassOver(f, g, layer, transmitted, behind, over);
    return over;
}

// Within the frame alone, less and less at rest, where the mean over frames does it: what is seen through glass moves
// otherwise than the surface, and otherwise than a reflection.
gpu::Image denoisedFrosted(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const Rays& rays) {
    DenoiseSettings within = settings.denoise;
    within.radius /= std::sqrt(1.0F + static_cast<float>(in.view.rest));
    LobeLight light;
    light.from = {rays.from.g, in.view, 1};
    light.radiance = answersOf(f, rays);
    return denoise(f, nullptr, light, lobeSpecular, in.view, within).radiance;
}

// What is seen through the layer, by its refraction in screen space or by paths of view rays.
RefractedRays raysThrough(gpu::PassList& f, const ViewInputs& in, const Settings& settings, TracedView& seen,
                          const GlassSurfaces& made) {
    const GBuffer& g = seen.images.g;
    if (refractsPaths(settings, in)) {
        RefractedRays rays = raysToGlass(f, g, made, in.view);
        Settings byPaths = settings;
        byPaths.traceScreen.enabled = 0;
        answerRays(f, rays.rays, in, byPaths, seen);
        if (in.draws.frosted && settings.denoise.enabled != 0) {
            rays.denoised = denoisedFrosted(f, in, settings, rays.rays);
        }
        return rays;
    }
    if (in.draws.frosted) {
        lighting::prefilterOwnLight(f, seen.screen);
    }
    RefractedRays rays = refractRays(
        f, g, made, in.ggxTable, {in.draws.dispersive, in.medium.has_value()},
        {in.view, settings.transmission.exitSteps, in.draws.frosted ? 1U : 0U, in.medium ? in.medium->outerIor : 1.0F});
    answerRays(f, rays.rays, in, refractedSettings(settings), seen);
    return rays;
}

// seen: with the layer's G-buffer, and the light behind it on screen. nearerDepth: of the layer in front, if any.
LightThroughGlass addLayer(gpu::PassList& f, const ViewInputs& in, const Settings& settings, TracedView seen,
                           gpu::Image nearerDepth, const LightLayers& behind) {
    const bool layers = bool(behind.indirectDiffuse);
    const GBuffer& g = seen.images.g;
    const LightLayers lit = lightLayer(f, in, settings, seen, layers);
    const GlassSurfaces made = glassSurfaces(f, in.draws, in.view, g, in.medium);
    const RefractedRays refracted = raysThrough(f, in, settings, seen, made);
    LightLayers out = behind;
    out.lit = glassOver(f, g, lit.lit, &refracted, behind.lit);
    if (layers) {
        out.direct = glassOver(f, g, seen.images.direct, nullptr, behind.direct);
        out.indirectDiffuse = glassOver(f, g, lit.indirectDiffuse, nullptr, behind.indirectDiffuse);
        out.indirectSpecular = glassOver(f, g, lit.indirectSpecular, &refracted, behind.indirectSpecular);
    }
    if (coatsGlass(in.draws, settings)) {
        out = addCoats(f, in, settings, seen, {g.depth, nearerDepth, CoatedSurfaces::Kind::glass}, out);
    }
    return {out, {g.depth, g.motion, made.tint}};
}

// Depth of the opaque surfaces, or of the glass where that is nearer: R32F.
gpu::Image depthWithGlass(gpu::PassList& f, const NearestGlass& nearest, gpu::Image opaqueDepth) {
    const gpu::Image depth = f.image("glass.depth", VK_FORMAT_R32_SFLOAT, opaqueDepth.size);
    f.compute("glass_depth", "glass_depth.comp")
        .read("opaque", opaqueDepth)
        .read("layer", nearest.depth)
        .write("nearest", depth)
        .params(GlassOverParams{depth.size})
        .dispatch(depth.size);
    return depth;
}

// Depth (R32F) and motion of the volumes of glass in front of what the light has moved with so far.
void followGlass(gpu::PassList& f, const NearestGlass& nearest, lighting::Light& light) {
    const uvec2 size = light.followedDepth.size;
    const gpu::Image depth = f.image("glass.followed_depth", VK_FORMAT_R32_SFLOAT, size);
    const gpu::Image motion = f.image("glass.followed_motion", VK_FORMAT_R16G16B16A16_SFLOAT, size);
    f.compute("glass_motion", "glass_motion.comp")
        .read("depth", light.followedDepth)
        .read("motion", light.followedMotion)
        .read("layerDepth", nearest.depth)
        .read("layerMotion", nearest.motion)
        .read("tint", nearest.tint)
        .write("followedDepth", depth)
        .write("followedMotion", motion)
        .params(GlassOverParams{size})
        .dispatch(size);
    light.followedDepth = depth;
    light.followedMotion = motion;
}

// With a depth pyramid if refracted rays march through one.
ScreenImages screenBehind(gpu::PassList& f, const TracedView& seen, const Settings& refracted) {
    ScreenImages screen = seen.screen;
    if (!screen.pyramid && lighting::marchesPyramid(refracted)) {
        lighting::Surfaces behind = seen.images;  // NOLINT(cppcoreguidelines-slicing): a copy to add the pyramid to
        screen.pyramid = lighting::depthPyramid(f, behind);
    }
    return screen;
}

}  // namespace

bool showsGlass(const ViewInputs& in, const Settings& settings) {
    return drawsGlass(in.draws, settings.transmission, settings.materials) &&
           anyDraws(in.draws,
                    {.keep = [](const Draw& draw) { return draw.glass; }, .worldToClip = in.view.worldToClip});
}

LightThroughGlass throughGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                               const LightLayers& behind, gpu::Image opaque) {
    LightThroughGlass sum{behind, {}};
    if (!showsGlass(in, settings)) {
        return sum;
    }
    const auto scope = f.scope("glass");
    const Settings ofLayer = glassSettings(settings, in.draws);
    const std::vector<GBuffer> peeled = peelGlass(f, in, ofLayer, seen.images.g.depth);
    const ScreenImages screen =
        refractsPaths(ofLayer, in) ? seen.screen : screenBehind(f, seen, refractedSettings(ofLayer));
    for (size_t i = peeled.size(); i-- > 0;) {
        const auto layerScope = f.scope(std::to_string(i));
        TracedView layer{seen.images, screen, {}};
        layer.images.g = peeled[i];
        layer.images.ambientOcclusion = {};
        layer.screen.light = opaque && refractsPaths(ofLayer, in) ? opaque : sum.light.lit;
        layer.screen.lit = {};
        layer.screen.lightMips = {};
        sum = addLayer(f, in, ofLayer, layer, i > 0 ? peeled[i - 1].depth : gpu::Image{}, sum.light);
    }
    return sum;
}

lighting::Light throughGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                             const lighting::Light& behind, gpu::Image opaque) {
    const LightThroughGlass through =
        throughGlass(f, in, settings, seen, static_cast<const LightLayers&>(behind), opaque);
    lighting::Light out = behind;
    static_cast<LightLayers&>(out) = through.light;
    if (through.nearest.depth) {
        out.depth = depthWithGlass(f, through.nearest, behind.depth);
        followGlass(f, through.nearest, out);
    }
    return out;
}

gpu::Image nearestGlass(gpu::PassList& f, const ViewInputs& in, const Settings& settings, gpu::Image opaqueDepth) {
    if (!showsGlass(in, settings)) {
        return {};
    }
    const auto scope = f.scope("glass");
    const GBufferContent content{
        .clipPlane = in.clipPlane, .opaqueDepth = opaqueDepth, .glass = true, .bothSides = mediumDraw(in)};
    return drawGBuffer(f, in.draws, in.view, settings.materials, content).depth;
}

}  // namespace reflet
