// Records the stages from light to a picture.
#include "lighting/picture.h"

#include "effects/exposure/exposure.h"
#include "effects/reflected_images/reflected_images.h"
#include "effects/tonemap/tonemap.h"

namespace reflet::lighting {

namespace {

constexpr VkFormat lightFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

// Whether `lit` has the size of the depth, so that what it shows can be looked up there.
bool fits(gpu::Image lit, const Surfaces& surfaces) {
    return lit && lit.size == surfaces.g.depth.size;
}

// What smooth surfaces reflect; none if nothing can be said of it.
std::optional<Reflections> reflectionsOf(const ViewContext& in, const Reflecting& reflecting) {
    const Surfaces& surfaces = reflecting.surfaces;
    if (reflecting.specular == nullptr || !fits(reflecting.lit, surfaces)) {
        return {};
    }
    return Reflections{surfaces.g, *reflecting.specular, reflecting.lit, in.ggxTable, in.lambertOnly};
}

// What exposure is measured of, before the lens and the shutter blur it; none if no picture fits.
gpu::Image meteredOf(const Light& light, const Surfaces& surfaces) {
    const gpu::Image sharp = light.sharp ? light.sharp : light.lit;
    if (fits(sharp, surfaces)) {
        return sharp;
    }
    return fits(light.unfiltered, surfaces) ? light.unfiltered : gpu::Image{};
}

}  // namespace

LobeLight blackLobe(gpu::PassList& f, const ViewContext& in, const Surfaces& surfaces, uint32_t lobe) {
    const auto scope = f.scope(lobe == lobeDiffuse ? "diffuse" : "specular");
    return reflet::blackLobe(f, {surfaces.g, in.view}, false);
}

Light lightOf(const Surfaces& surfaces, gpu::Image lit) {
    Light light;
    light.lit = lit;
    light.depth = surfaces.shownDepth ? surfaces.shownDepth : surfaces.g.depth;
    light.followedDepth = light.depth;
    light.reactive = surfaces.reactive;
    light.baseColor = surfaces.g.baseColor;
    light.followedMotion = surfaces.g.motion;
    return light;
}

Light compose(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, const Surfaces& surfaces,
              const LightParts& parts, bool layers, gpu::Image into) {
    Light light = lightOf(surfaces, parts.direct);
    light.direct = parts.direct;
    if (parts.diffuse.dark && parts.specular.dark && !layers) {
        return light;
    }
    const gpu::Image sum = into ? into : f.image("lit", lightFormat, surfaces.g.depth.size);
    static_cast<LightLayers&>(light) =
        composite(f,
                  {surfaces.g, parts.direct, parts.diffuse, parts.specular, in.ggxTable, in.lambertOnly, layers,
                   parts.fromEmitters, parts.highlights, parts.limits},
                  sum, {in.view, settings.diffuse.gain});
    return light;
}

Light withoutDirect(gpu::PassList& f, const Light& light) {
    Light out = light;
    out.lit = reflet::withoutDirect(f, light.lit, light.direct);
    return out;
}

Light accumulate(gpu::PassList& f, AccumulateHistory& own, const Light& light, uint32_t framesBefore) {
    Light out = light;
    static_cast<LightLayers&>(out) = reflet::accumulate(f, own.light, light, framesBefore);
    if (light.coverage) {
        const auto scope = f.scope("coverage");
        const gpu::Image& c = light.coverage;
        out.coverage = reflet::accumulate(f, own.coverage, {c, c, c, c}, framesBefore).direct;
    }
    return out;
}

Light antialias(gpu::PassList& f, TemporalStore& own, const ViewContext& in, const LightingSettings& settings,
                const Reflecting& reflecting, const Light& light, const Antialiasing& to) {
    ShownImages shown{light.followedDepth, light.followedMotion};
    std::optional<Reflections> reflections = reflectionsOf(in, reflecting);
    if (reflections && settings.temporal.reflections != 0) {
        const auto scope = f.scope("temporal");
        reflections->upscaled = to.size != shown.depth.size;
        shown = withReflectedImages(f, *reflections, in.view, shown);
    }
    const TemporalImages means = temporal(f, own,
                                          {.depth = shown.depth,
                                           .motion = shown.motion,
                                           .radiance = light.lit,
                                           .coverage = light.coverage,
                                           .view = in.view,
                                           .outputSize = to.size,
                                           .jitter = to.jitter,
                                           .sky = light.coverage ? nullptr : to.sky,
                                           .reactive = light.reactive,
                                           .baseColor = light.baseColor,
                                           .mixesSizes = to.mixesSizes},
                                          settings.temporal);
    Light out = light;
    out.unfiltered = unfilteredOf(light);
    out.antialiased = means.mean;
    out.lit = means.mean;
    out.coverage = means.coverage;
    return out;
}

Light defocus(gpu::PassList& f, DofHistory& own, const ViewContext& in, const LightingSettings& settings,
              const Lens& lens, const Reflecting& reflecting, const Light& light) {
    if (!blurs(lens, settings.dof)) {
        return light;
    }
    Light out = light;
    out.unfiltered = unfilteredOf(light);
    const GBuffer& g = reflecting.surfaces.g;
    DofInputs blur{.radiance = light.lit,
                   .depth = g.depth,
                   .motion = light.antialiased ? g.motion : gpu::Image{},
                   .view = in.view,
                   .lens = lens,
                   .settings = settings.dof,
                   .reflections = reflectionsOf(in, reflecting)};
    const DofImages blurred = depthOfField(f, own.light, blur);
    out.sharp = light.lit;
    out.lit = blurred.radiance;
    out.circleOfConfusion = blurred.coc;
    if (light.coverage) {
        const auto scope = f.scope("coverage");
        blur.radiance = light.coverage;
        out.coverage = depthOfField(f, own.coverage, blur).radiance;
    }
    return out;
}

Light blurMotion(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, const Light& light,
                 const mat4* cameraBefore) {
    if (!blurs(settings.motionBlur)) {
        return light;
    }
    Light out = light;
    out.unfiltered = unfilteredOf(light);
    ViewParams view = in.view;
    view.previousWorldToClip = cameraBefore != nullptr ? *cameraBefore : view.previousWorldToClip;
    MotionBlurInputs blur{.radiance = light.lit,
                          .depth = light.followedDepth,
                          .motion = cameraBefore != nullptr ? gpu::Image{} : light.followedMotion,
                          .view = view,
                          .settings = settings.motionBlur};
    const MotionBlurImages blurred = motionBlur(f, blur);
    out.sharp = light.sharp ? light.sharp : light.lit;
    out.lit = blurred.radiance;
    out.motionTiles = blurred.tiles;
    if (light.coverage) {
        const auto scope = f.scope("coverage");
        blur.radiance = light.coverage;
        out.coverage = motionBlur(f, blur).radiance;
    }
    return out;
}

bool canMeter(const Light& light, const Surfaces& surfaces) {
    return bool(meteredOf(light, surfaces));
}

gpu::Image exposure(gpu::PassList& f, gpu::HistoryImage& own, const LightingSettings& settings,
                    const Surfaces& surfaces, const Light& light, float elapsed, float preExposure) {
    return measureExposure(f, own, meteredOf(light, surfaces), surfaces.g.depth, elapsed, settings.tonemap.adaptation,
                           preExposure);
}

gpu::Image display(gpu::PassList& f, const LightingSettings& settings, gpu::Image radiance, gpu::Image exposure) {
    return tonemap(f, radiance, settings.tonemap, exposure);
}

}  // namespace reflet::lighting
