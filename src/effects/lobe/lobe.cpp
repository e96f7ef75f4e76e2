// Records a lobe: picks surfaces, generates rays, asks the sources in turn, resolves and denoises.
#include "effects/lobe/lobe.h"

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

// Rays of one batch, answered by the sources in turn.
Rays answeredRays(gpu::PassList& f, const LobeInputs& in, const RayGeneration& generation, bool sliced) {
    Rays rays = sliced ? startSlices(f, generation, in.screen, in.diffuse.sliceSteps) : generateRays(f, generation);
    if (in.screen.images != nullptr && !sliced) {
        traceScreen(f, rays, *in.screen.images, in.screen.settings, in.screen.longest);
    }
    for (const RaySource& source : in.sources) {
        source(f, rays);
    }
    answerEnvironment(f, rays, in.environment, in.environmentSettings);
    return rays;
}

}  // namespace

LobeLight traceLobe(gpu::PassList& f, LobeStore* own, const LobeInputs& in) {
    const auto scope = f.scope(lobeNames[in.lobe]);
    const LobeSettings& s = in.settings;
    if (s.rays == 0) {
        return blackLobe(f, {in.g, in.view}, in.countSteps);
    }
    RaySurfaces from = pickSurfaces(f, in.g, in.view, s.downsample);
    from.ambientOcclusion = in.ambientOcclusion;
    const RayTiles tiles = tilesOfLobe(f, own, from, in);
    const bool varies = tiles.meanRays > 0;
    const uint32_t most = tiles.mostRays;
    const bool reflects = in.lobe == lobeSpecular;
    const gpu::Image imageMotion = reflects && keepsHistory(own, in.denoise) ? noImageMotion(f, from) : gpu::Image{};
    // Rays that nothing reads between the passes need not be written.
    const bool atOnce = in.sources.empty() && s.reuse == 0 && !varies;
    const bool sliced = !reflects && in.diffuse.method == DiffuseMethod::slices && in.screen.images != nullptr &&
                        in.diffuse.distribution == RayDistribution::cosine && !varies;
    const uint32_t fit = atOnce ? maxRaysAtOnce : raysPerBatch(f, from.g.depth.size);
    const uint32_t batch = varies ? most : fit;
    const bool reused = s.reuse > 0 && !varies && batch >= s.rays;
    const bool directional = !reflects && in.denoise.enabled != 0 && in.denoise.directional != 0;
    LobeLight light = lobeImages(f, from, in.countSteps, directional);
    light.tiles = tiles;
    light.imageMotion = imageMotion;
    for (uint32_t first = 0; first < most; first += batch) {
        const RayGeneration generation{
            .from = from,
            .tiles = tiles,
            .ggxTable = in.ggxTable,
            .blueNoise = in.blueNoise,
            .noise = s.noise,
            .lobe = in.lobe,
            .params = {{}, in.diffuse, in.specular, first, std::min(most - first, batch), in.coneShare},
            .imageMotion = imageMotion,
            .countSteps = in.countSteps,
            .directional = directional};
        if (atOnce && sliced) {
            slicesAtOnce(f, light, generation, in.screen, in.diffuse.sliceSteps,
                         {in.environment, in.environmentSettings});
            continue;
        }
        if (atOnce) {
            traceAtOnce(f, light, generation, in.screen, {in.environment, in.environmentSettings});
            continue;
        }
        Rays rays = answeredRays(f, in, generation, sliced);
        if (reused) {
            reuseRays(f, light, rays, in.view, s.reuse);
        } else {
            resolveRays(f, light, rays);
        }
    }
    DenoiseStore* history = own != nullptr ? &own->denoise : nullptr;
    return in.denoise.enabled != 0 ? denoise(f, history, light, in.lobe, in.view, in.denoise) : light;
}

}  // namespace reflet
