// Records the screen and planar reflections as ray sources.
#include "effects/lobe/trace_screen.h"

#include <algorithm>

namespace reflet {

namespace {

struct Trace {
    const ScreenImages& seen;
    uint32_t through = throughScreen;
    MirrorParams mirror{};
};

// The pass as shared by both sources. rays.waiting: in: rays to trace; out: misses.
void record(gpu::PassList& f, gpu::ComputePass pass, Rays& rays, const Trace& trace,
            const TraceScreenSettings& settings, float longest) {
    const bool countSteps = rays.countSteps && trace.through == throughScreen;
    const gpu::BufferView missed = makeRayList(f, rays);
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
                .firstRay = rays.firstRay},
               rays.imageMotion)
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
        .dispatchIndirect(rays.waiting, 0);
    rays.waiting = missed;
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

gpu::ComputePass& bindScreenLight(gpu::PassList& f, gpu::ComputePass& pass, const ScreenImages& seen,
                                  TraceScreenParams params) {
    const bool previous = seen.lit.valid;
    const bool leavesOut = seen.emitters != EmittersAtHits::all;
    const gpu::Image light = seen.light ? seen.light : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT);
    params.view = seen.view;
    params.previousValid = previous ? 1U : 0U;
    params.longest = std::min(params.longest, params.settings.maxDistance);
    return pass.constant("readsPrevious", params.settings.light == HitLight::previous ? 1U : 0U)
        .constant("secondLayer", seen.backDepth ? 1U : 0U)
        .constant("emittersAtHits", static_cast<uint32_t>(seen.emitters))
        .constant("leavesOutMirrors", seen.leavesOutMirrors ? 1U : 0U)
        .constant("cones", seen.lightMips ? 1U : 0U)
        .read("depth", seen.g.depth)
        .read("backDepth", seen.backDepth ? seen.backDepth : seen.g.depth)
        .read("geometricNormal", seen.g.geometricNormal)
        .read("motion", seen.g.motion)
        .read("light", light)
        .read("previousLit", previous ? seen.lit.previous : light)
        .read("hitMaterial", leavesOut || seen.leavesOutMirrors ? seen.g.material : light)
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
    record(f, f.compute("trace_screen", "trace_screen.comp"), rays, {screen}, settings, longest);
}

void traceMirror(gpu::PassList& f, Rays& rays, const PlanarView& mirror, const TraceScreenSettings& settings,
                 float longest) {
    record(f, f.compute("trace_mirror", "trace_screen.comp"), rays,
           {mirror.seen, throughOf(mirror.form), mirror.mirror}, settings, longest);
}

}  // namespace reflet
