// Records a lobe: picks surfaces, generates rays, asks the sources in turn, resolves and denoises.
#include "effects/lobe/lobe.h"

#include "base/error.h"
#include "effects/lobe/adaptive_rays.h"
#include "effects/lobe/reuse_rays.h"
#include "effects/lobe/trace_slices.h"

#include <algorithm>

namespace reflet {

namespace {

// Bounds the time of one dispatch: devices end those that take seconds.
constexpr uint32_t maxRaysAtOnce = 8;

constexpr const char* lobeNames[] = {"diffuse", "specular"};

bool keepsHistory(const LobeStore* own, const DenoiseSettings& denoise) {
    return own != nullptr && denoise.enabled != 0 && denoise.history > 0;
}

// No motion of reflected images, unless a source overwrites it.
gpu::Image noImageMotion(gpu::PassList& f, const RaySurfaces& from) {
    const gpu::Image motion = f.image("image_motion", VK_FORMAT_R16G16_SFLOAT, from.g.depth.size);
    f.clear(motion);
    return motion;
}

// Rays per tile. Adaptive sampling needs the denoiser's history. All rays of a mirror's pixel are identical unless
// their tracing is random; reuse requires a fixed count.
RayTiles tilesOfLobe(gpu::PassList& f, LobeStore* own, const RaySurfaces& from, const LobeInputs& in) {
    const LobeSettings& s = in.settings;
    const RayCounts counts{s.rays, s.reuse > 0 || in.randomTracing ? s.rays : std::min(s.rays, 1U),
                           keepsHistory(own, in.denoise) && s.reuse == 0 ? in.specular.roughRays : 1.0F};
    const uvec2 size = from.g.depth.size;
    const bool adaptive = s.adaptive && keepsHistory(own, in.denoise) && in.lit.next;
    if (!adaptive || s.rays > raysPerBatch(f, size, maxAdaptiveRays)) {
        return classifyTiles(f, from, in.lobe, counts);
    }
    const DenoiseHistory past = denoiseHistory(f, &own->denoise, in.lobe, size, in.denoise);
    return shareRays(f, own->adaptiveTiles, from, in.lobe, counts,
                     {past.light.previous, past.surface.previous, past.moments.previous, in.lit.previous,
                      past.valid && in.lit.valid});
}

// Rays of a pixel in a pass that traces and averages: one where rays that have not ended are collected, which several
// of them would have to wait for; but more if there are many, as each pass reads the surfaces again.
uint32_t raysAtOnce(const gpu::Context& context, const LobeInputs& in) {
    const bool alone =
        in.screen.images != nullptr && compactsRays(context, in.screen.settings) && in.settings.rays <= 4;
    return alone ? 1 : maxRaysAtOnce;
}

// separate: rays must be in memory, in one batch.
LobePlan planLobe(gpu::PassList& f, LobeStore* own, const LobeInputs& in, bool separate) {
    const LobeSettings& s = in.settings;
    LobePlan plan;
    plan.from = pickSurfaces(f, in.g, in.view, s.downsample);
    plan.from.ambientOcclusion = in.ambientOcclusion;
    plan.tiles = tilesOfLobe(f, own, plan.from, in);
    const bool varies = plan.tiles.meanRays > 0;
    const bool reflects = in.lobe == lobeSpecular;
    const bool followed = keepsHistory(own, in.denoise) || in.followsImages;
    plan.imageMotion = reflects && followed ? noImageMotion(f, plan.from) : gpu::Image{};
    // Rays that nothing reads between the passes need not be written.
    plan.atOnce = !separate && in.sources.empty() && in.others.empty() && s.reuse == 0 && !varies && !in.countHits;
    plan.sliced = !reflects && in.diffuse.method == DiffuseMethod::slices && in.screen.images != nullptr &&
                  in.diffuse.distribution == RayDistribution::cosine && !varies;
    const uint32_t fit = plan.atOnce && !plan.sliced ? raysAtOnce(f.context(), in)
                         : plan.atOnce               ? maxRaysAtOnce
                                                     : raysPerBatch(f, plan.from.g.depth.size);
    plan.batch = varies || separate ? plan.tiles.mostRays : fit;
    plan.reused = s.reuse > 0 && !varies && fit >= s.rays;
    plan.directional = !reflects && in.denoise.enabled != 0 && in.denoise.directional != 0;
    return plan;
}

// Of the batch that begins with ray `first` of each pixel.
RayGeneration generationOf(const LobeInputs& in, const LobePlan& plan, uint32_t first) {
    const uint32_t count = std::min(plan.tiles.mostRays - first, plan.batch);
    return {.from = plan.from,
            .tiles = plan.tiles,
            .ggxTable = in.ggxTable,
            .blueNoise = in.blueNoise,
            .noise = in.settings.noise,
            .lobe = in.lobe,
            .params = {{}, in.diffuse, in.specular, first, count, in.coneShare, in.roughestHighlight},
            .imageMotion = plan.imageMotion,
            .countSteps = in.countSteps,
            .directional = plan.directional};
}

gpu::Image hitsImage(gpu::PassList& f, const RaySurfaces& from) {
    return f.image("hits", VK_FORMAT_R32G32_SFLOAT, from.g.depth.size);
}

LobeLight lightWithoutRays(gpu::PassList& f, const LobeInputs& in) {
    LobeLight light = blackLobe(f, {in.g, in.view}, in.countSteps);
    if (in.countHits) {
        light.hits = hitsImage(f, light.from);
        f.clear(light.hits);
    }
    return light;
}

LobeLight emptyLight(gpu::PassList& f, const LobeInputs& in, const LobePlan& plan) {
    LobeLight light = lobeImages(f, plan.from, in.countSteps, plan.directional);
    light.tiles = plan.tiles;
    light.imageMotion = plan.imageMotion;
    light.hits = in.countHits ? hitsImage(f, plan.from) : gpu::Image{};
    return light;
}

Rays beginBatch(gpu::PassList& f, const LobeInputs& in, const LobePlan& plan, const RayGeneration& generation) {
    Rays rays =
        plan.sliced ? startSlices(f, generation, in.screen, in.diffuse.sliceSteps) : generateRays(f, generation);
    if (in.screen.images != nullptr && !plan.sliced) {
        traceScreen(f, rays, *in.screen.images, in.screen.settings, in.screen.longest);
    }
    for (const RaySource& source : in.sources) {
        source(f, rays);
    }
    return rays;
}

void finishBatch(gpu::PassList& f, const LobeInputs& in, const LobePlan& plan, Rays rays, const LobeLight& light) {
    for (const RaySource& source : in.others.first(in.certainOthers)) {
        source(f, rays);
    }
    if (light.hits) {
        sumHits(f, light, rays);
    }
    for (const RaySource& source : in.others.subspan(in.certainOthers)) {
        source(f, rays);
    }
    answerEnvironment(f, rays, in.environment, in.environmentSettings);
    if (plan.reused) {
        reuseRays(f, light, rays, in.view, in.settings.reuse);
    } else {
        resolveRays(f, light, rays);
    }
}

void traceBatchAtOnce(gpu::PassList& f, const LobeInputs& in, const LobePlan& plan, const RayGeneration& generation,
                      const LobeLight& light) {
    const EnvironmentSource environment{in.environment, in.environmentSettings};
    if (plan.sliced) {
        slicesAtOnce(f, light, generation, in.screen, in.diffuse.sliceSteps, environment);
    } else {
        traceAtOnce(f, light, generation, in.screen, environment);
    }
}

LobeLight denoised(gpu::PassList& f, LobeStore* own, const LobeInputs& in, LobeLight light) {
    DenoiseStore* history = own != nullptr ? &own->denoise : nullptr;
    const bool remembers = in.cache && history != nullptr;
    if (remembers) {
        feedCache(f, in.cache, light);
    }
    if (in.denoise.enabled == 0) {
        return light;
    }
    if (remembers && in.denoise.history > 0) {
        light.remembered = rememberedLight(f, in.cache, light.from);
    }
    return denoise(f, history, light, in.lobe, in.view, in.denoise);
}

}  // namespace

LobeLight traceLobe(gpu::PassList& f, LobeStore* own, const LobeInputs& in) {
    const auto scope = f.scope(lobeNames[in.lobe]);
    if (in.settings.rays == 0) {
        return lightWithoutRays(f, in);
    }
    const LobePlan plan = planLobe(f, own, in, false);
    const LobeLight light = emptyLight(f, in, plan);
    for (uint32_t first = 0; first < plan.tiles.mostRays; first += plan.batch) {
        const RayGeneration generation = generationOf(in, plan, first);
        if (plan.atOnce) {
            traceBatchAtOnce(f, in, plan, generation, light);
        } else {
            finishBatch(f, in, plan, beginBatch(f, in, plan, generation), light);
        }
    }
    return denoised(f, own, in, light);
}

BegunLobe beginLobe(gpu::PassList& f, LobeStore* own, const LobeInputs& in) {
    const auto scope = f.scope(lobeNames[in.lobe]);
    const LobePlan plan = planLobe(f, own, in, true);
    const uvec2 size = plan.from.g.depth.size;
    const uint32_t fit = raysPerBatch(f, size, maxRaysInList);
    if (plan.batch > fit) {
        failUsage(
            "{0}.rays: {1} rays for each of {2}x{3} pixels do not fit into one list, which takes {4}; set fewer, "
            "or a larger {0}.downsample",
            lobeNames[in.lobe], plan.batch, size.x, size.y, fit);
    }
    return {plan, beginBatch(f, in, plan, generationOf(in, plan, 0))};
}

LobeLight finishLobe(gpu::PassList& f, LobeStore* own, const LobeInputs& in, const BegunLobe& begun) {
    const auto scope = f.scope(lobeNames[in.lobe]);
    const LobeLight light = emptyLight(f, in, begun.plan);
    finishBatch(f, in, begun.plan, begun.rays, light);
    return denoised(f, own, in, light);
}

}  // namespace reflet
