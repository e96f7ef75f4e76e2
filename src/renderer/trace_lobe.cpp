// Names the sources of a lobe's rays.
#include "renderer/trace_lobe.h"

#include "effects/probe/answer_probes.h"
#include "renderer/scene_source.h"

#include <utility>

namespace reflet {

namespace {

// Keeps references to what it is given.
lighting::RaySources sourcesOf(const ViewInputs& in, const Settings& settings, const TracedView& seen) {
    const bool scene = settings.traceScene.enabled != 0;
    lighting::RaySources sources{.mirrors = seen.mirrors,
                                 .mirrorsFirst = settings.planar.beforeScreen != 0,
                                 .others = {},
                                 .random = scene,
                                 .readScreen = scene && settings.traceScene.reuseScreen != 0};
    if (scene && in.traced != nullptr) {
        sources.others.emplace_back(
            [&](gpu::PassList& f, Rays& rays) { traceSceneFallback(f, rays, in, settings, seen.images, seen.screen); });
        sources.certainOthers = 1;
    }
    if (in.probes) {
        sources.others.emplace_back([&](gpu::PassList& f, Rays& rays) { answerProbes(f, rays, in.probes); });
    }
    return sources;
}

}  // namespace

TracedView tracedView(gpu::PassList& f, const ViewInputs& in, const Settings& settings, ViewImages images,
                      const gpu::History& lit) {
    TracedView seen{std::move(images), {}, {}};
    seen.screen = lighting::screenOf(f, contextOf(in, settings), settings, seen.images, seen.images.direct, lit);
    return seen;
}

LobeLight traceLobe(gpu::PassList& f, LobeStore* history, const ViewInputs& in, const Settings& settings,
                    const TracedView& seen, uint32_t lobe) {
    return lighting::traceLobe(f, history, contextOf(in, settings), settings, lobe, seen.images, seen.screen,
                               sourcesOf(in, settings, seen));
}

void answerRays(gpu::PassList& f, Rays& rays, const ViewInputs& in, const Settings& settings, const TracedView& seen) {
    lighting::answerRays(f, rays, contextOf(in, settings), settings, seen.screen, sourcesOf(in, settings, seen));
}

bool readsScreenLight(const ViewInputs& in, const Settings& settings, const TracedView& seen) {
    return lighting::readsScreenLight(settings, sourcesOf(in, settings, seen));
}

}  // namespace reflet
