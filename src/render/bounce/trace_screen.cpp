// Records the screen as a source of answers.
#include "render/bounce/trace_screen.h"

namespace reflet {

void traceScreen(gpu::Frame& f, Rays& rays, const GBuffer& g, gpu::Image pyramid, gpu::Image direct,
                 const gpu::History& lit, const ViewParams& view, const TraceScreenSettings& settings) {
    const gpu::BufferView missed = makeRayList(f, rays, "rays.missed_by_screen");
    f.compute("trace_screen", "trace_screen.comp")
        .constant("method", static_cast<uint32_t>(settings.method))
        .read("depth", g.depth)
        .read("pyramid", pyramid ? pyramid : g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("motion", g.motion)
        .read("direct", direct)
        .read("previousLit", lit.previous)
        .read("direction", rays.direction)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("missed", missed)
        .params(TraceScreenParams{view, settings, rays.firstRay, lit.valid ? 1U : 0U})
        .dispatchIndirect(rays.waiting, 0);
    rays.waiting = missed;
}

}  // namespace reflet
