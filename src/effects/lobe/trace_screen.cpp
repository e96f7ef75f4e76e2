// Records the screen and planar reflections as ray sources.
#include "effects/lobe/trace_screen.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>
#include <array>

namespace reflet {

namespace {

struct Trace {
    const ScreenImages& seen;
    uint32_t through = throughScreen;
    MirrorParams mirror{};
};

// Steps after which rays that have not ended are collected. Lane-steps of waves of 64 per ray, mean of five scenes:
// reflections 104 without, 63 with 32, 49 with 32 and 64; diffuse rays 64, 50, 46.
constexpr std::array<uint32_t, 2> phaseEnds{32, 64};

// The pass as shared by both sources. missed: list of the misses.
void record(gpu::PassList& f, gpu::ComputePass pass, Rays& rays, const Trace& trace,
            const TraceScreenSettings& settings, float longest, const MarchPhase& phase, gpu::BufferView missed) {
    const bool countSteps = rays.countSteps && trace.through == throughScreen;
    ScreenImages seen = trace.seen;
    if (trace.through != throughScreen) {
        seen.lit = {};
    }
    bindRayOrigins(f, pass, rays);
    bindScreen(f, pass, seen,
               {.own = rays.from.view,
                .mirror = trace.mirror,
                .settings = settings,
                .longest = longest,
                .firstStep = phase.first,
                .endStep = phase.end,
                .firstRay = rays.firstRay},
               rays.imageMotion);
    bindMarchPhase(pass, phase, rays.waiting, missed)
        .constant("countSteps", countSteps ? 1U : 0U)
        .constant("through", trace.through)
        .read("ownDepth", rays.from.g.depth)
        .read("ownGeometricNormal", rays.from.g.geometricNormal)
        .read("direction", rays.direction)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("steps", rays.steps)
        .write("missed", missed)
        .dispatchIndirect(phase.unfinished ? phase.unfinished : rays.waiting, 0);
}

uint32_t throughOf(PlanarForm form) {
    switch (form) {
        case PlanarForm::traced:
            return throughMirror;
        case PlanarForm::camera:
            return throughMirrorCamera;
        default:
            return throughMirrorLookup;
    }
}

}  // namespace

bool compactsRays(const gpu::Context& context, const TraceScreenSettings& settings) {
    const bool compacts = settings.compaction == RayCompaction::always ||
                          (settings.compaction == RayCompaction::device && !context.isCpu());
    return compacts && settings.method == TraceMethod::hiz && settings.maxSteps > phaseEnds[0];
}

std::vector<MarchPhase> marchPhases(gpu::PassList& f, const TraceScreenSettings& settings, VkDeviceSize rays) {
    std::vector<MarchPhase> phases{{.end = settings.maxSteps}};
    if (!compactsRays(f.context(), settings)) {
        return phases;
    }
    for (const uint32_t end : phaseEnds) {
        rays = (rays + 1) / 2;  // the others, if there are more, end in their phase
        if (end < settings.maxSteps) {
            const gpu::BufferView list = f.buffer("unfinished", rayListHeader + rays * sizeof(UnfinishedRay));
            clearRayList(f, list);
            phases.back().end = end;
            phases.back().longer = list;
            phases.push_back({.first = end, .end = settings.maxSteps, .unfinished = list});
        }
    }
    return phases;
}

std::string nameOf(const MarchPhase& phase) {
    return phase.first > 0 ? "." + std::to_string(phase.first) : "";
}

gpu::ComputePass& bindMarchPhase(gpu::ComputePass& pass, const MarchPhase& phase, gpu::BufferView spareToRead,
                                 gpu::BufferView spareToWrite) {
    return pass.constant("continues", phase.unfinished ? 1U : 0U)
        .constant("collects", phase.longer ? 1U : 0U)
        .read("unfinished", phase.unfinished ? phase.unfinished : spareToRead)
        .write("longer", phase.longer ? phase.longer : spareToWrite);
}

gpu::ComputePass& bindScreenLight(gpu::PassList& f, gpu::ComputePass& pass, const ScreenImages& seen,
                                  TraceScreenParams params) {
    const bool previous = seen.lit.valid;
    const bool leavesOut = seen.emitters != EmittersAtHits::all;
    const bool readsMaterial = leavesOut || seen.metalsLeftOut != MetalsLeftOut::none;
    const gpu::Image light = seen.light ? seen.light : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT);
    params.view = seen.view;
    params.previousValid = previous ? 1U : 0U;
    params.longest = std::min(params.longest, params.settings.maxDistance);
    return pass.constant("readsPrevious", params.settings.light == HitLight::previous ? 1U : 0U)
        .constant("secondLayer", seen.backDepth ? 1U : 0U)
        .constant("emittersAtHits", static_cast<uint32_t>(seen.emitters))
        .constant("metalsLeftOut", static_cast<uint32_t>(seen.metalsLeftOut))
        .constant("cones", seen.lightMips ? 1U : 0U)
        .read("depth", seen.g.depth)
        .read("backDepth", seen.backDepth ? seen.backDepth : seen.g.depth)
        .read("geometricNormal", seen.g.geometricNormal)
        .read("motion", seen.g.motion)
        .read("light", light)
        .read("previousLit", previous ? seen.lit.previous : light)
        .read("hitMaterial", readsMaterial ? seen.g.material : light)
        .read("hitEmissive", leavesOut ? seen.g.emissive : light)
        .read("lightMips", seen.lightMips ? seen.lightMips : light)
        .params(params);
}

gpu::ComputePass& bindScreen(gpu::PassList& f, gpu::ComputePass& pass, const ScreenImages& seen,
                             const TraceScreenParams& params, gpu::Image imageMotion) {
    const bool tellsMotion = imageMotion && params.firstRay == 0;
    const TraceScreenSettings& s = params.settings;
    const bool fades = s.edgeFade > 0 || s.distanceFade > 0 || s.cameraFade > 0;
    return bindScreenLight(f, pass, seen, params)
        .constant("method", static_cast<uint32_t>(s.method))
        .constant("bisects", s.binarySteps > 0 ? 1U : 0U)
        .constant("interpolates", s.interpolate)
        .constant("jitters", s.jitter)
        .constant("rejectsBackfaces", s.rejectBackfaces)
        .constant("fades", fades ? 1U : 0U)
        .constant("certainNext", seen.certainNext ? 1U : 0U)
        .constant("tellsMotion", tellsMotion ? 1U : 0U)
        .read("pyramid", seen.pyramid ? seen.pyramid : f.placeholder(VK_FORMAT_R32G32_SFLOAT))
        .write("imageMotion", tellsMotion ? imageMotion : f.placeholder(VK_FORMAT_R16G16_SFLOAT));
}

void traceScreen(gpu::PassList& f, Rays& rays, const ScreenImages& screen, const TraceScreenSettings& settings,
                 float longest) {
    const gpu::Image& images = rays.direction;
    const gpu::BufferView missed = makeRayList(f, rays);
    for (const MarchPhase& phase :
         marchPhases(f, settings, VkDeviceSize(images.size.x) * images.size.y * images.layers)) {
        record(f, f.compute("trace_screen" + nameOf(phase), "trace_screen.comp"), rays, {screen}, settings, longest,
               phase, missed);
    }
    rays.waiting = missed;
}

void traceMirror(gpu::PassList& f, Rays& rays, const PlanarView& mirror, const TraceScreenSettings& settings,
                 float longest) {
    REFLET_CHECK(settings.method != TraceMethod::hiz || mirror.seen.pyramid || mirror.form != PlanarForm::traced,
                 "a planar view without a pyramid");
    const gpu::BufferView missed = makeRayList(f, rays);
    record(f, f.compute("trace_mirror", "trace_screen.comp"), rays,
           {mirror.seen, throughOf(mirror.form), mirror.mirror}, settings, longest, {.end = settings.maxSteps}, missed);
    rays.waiting = missed;
}

}  // namespace reflet
