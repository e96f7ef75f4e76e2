// Records the screen as a source of answers.
#include "render/bounce/trace_screen.h"

#include <algorithm>

namespace reflet {

void traceScreen(gpu::Frame& f, Rays& rays, const ScreenImages& screen, const ViewParams& view,
                 const TraceScreenSettings& settings, float longest) {
    const GBuffer& g = screen.g;
    const gpu::BufferView missed = makeRayList(f, rays, "rays.missed_by_screen");
    f.compute("trace_screen", "trace_screen.comp")
        .constant("method", static_cast<uint32_t>(settings.method))
        .constant("secondLayer", screen.backDepth ? 1U : 0U)
        .constant("cones", screen.lightMips ? 1U : 0U)
        .constant("countSteps", rays.countSteps ? 1U : 0U)
        .read("depth", g.depth)
        .read("backDepth", screen.backDepth ? screen.backDepth : g.depth)
        .read("pyramid", screen.pyramid ? screen.pyramid : g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("motion", g.motion)
        .read("light", screen.light)
        .read("previousLit", screen.lit.previous)
        .read("lightMips", screen.lightMips ? screen.lightMips : screen.light)
        .read("direction", rays.direction)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("steps", rays.steps)
        .write("missed", missed)
        .params(TraceScreenParams{view, settings, std::min(longest, settings.maxDistance), rays.firstRay,
                                  screen.lit.valid ? 1U : 0U})
        .dispatchIndirect(rays.waiting, 0);
    rays.waiting = missed;
}

}  // namespace reflet
