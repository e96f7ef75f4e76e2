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
void record(gpu::Recorder& f, gpu::Pass pass, Rays& rays, const Trace& trace, const TraceScreenSettings& settings,
            float longest) {
    const ScreenImages& seen = trace.seen;
    const bool countSteps = rays.countSteps && trace.through == throughScreen;
    const bool tellsMotion = rays.imageMotion && rays.firstRay == 0;
    const bool previous = trace.through == throughScreen && seen.lit.valid;
    const gpu::BufferView missed = makeRayList(f, rays);
    pass.constant("method", static_cast<uint32_t>(settings.method))
        .constant("secondLayer", seen.backDepth ? 1U : 0U)
        .constant("cones", seen.lightMips ? 1U : 0U)
        .constant("countSteps", countSteps ? 1U : 0U)
        .constant("through", trace.through)
        .constant("tellsMotion", tellsMotion ? 1U : 0U)
        .read("ownDepth", rays.from.g.depth)
        .read("ownGeometricNormal", rays.from.g.geometricNormal)
        .read("depth", seen.g.depth)
        .read("backDepth", seen.backDepth ? seen.backDepth : seen.g.depth)
        .read("pyramid", seen.pyramid ? seen.pyramid : f.placeholder(VK_FORMAT_R32G32_SFLOAT))
        .read("geometricNormal", seen.g.geometricNormal)
        .read("motion", seen.g.motion)
        .read("light", seen.light)
        .read("previousLit", previous ? seen.lit.previous : seen.light)
        .read("lightMips", seen.lightMips ? seen.lightMips : seen.light)
        .read("direction", rays.direction)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("steps", rays.steps)
        .write("imageMotion", tellsMotion ? rays.imageMotion : f.placeholder(VK_FORMAT_R16G16_SFLOAT))
        .write("missed", missed)
        .params(TraceScreenParams{rays.from.view, seen.view, trace.mirror, settings,
                                  std::min(longest, settings.maxDistance), rays.firstRay, previous ? 1U : 0U})
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

void traceScreen(gpu::Recorder& f, Rays& rays, const ScreenImages& screen, const TraceScreenSettings& settings,
                 float longest) {
    record(f, f.compute("trace_screen", "trace_screen.comp"), rays, {screen}, settings, longest);
}

void traceMirror(gpu::Recorder& f, Rays& rays, const PlanarView& mirror, const TraceScreenSettings& settings,
                 float longest) {
    record(f, f.compute("trace_mirror", "trace_screen.comp"), rays,
           {mirror.seen, throughOf(mirror.form), mirror.mirror}, settings, longest);
}

}  // namespace reflet
