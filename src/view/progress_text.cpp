// Says how far the picture is.
#include "view/progress_text.h"

namespace reflet {

std::string progressText(const RenderThread::State& published, Running running, const std::string& job) {
    const RenderedImage& shown = *published.live;
    if (!job.empty()) {
        return job;
    }
    if (published.compiling > 0) {
        return fmt::format("compiling {} shaders", published.compiling);
    }
    if (running == Running::paused) {
        return shown.rendered == 0 ? "paused" : fmt::format("frame {}, paused", shown.frames);
    }
    if (shown.rendered == 0) {
        return shown.problem.empty() ? "compiling shaders" : "not rendered";
    }
    if (published.effort.isReduced()) {
        return fmt::format("moving: resolution x {:.2f}{}", published.effort.scale,
                           published.effort.fewRays ? ", 1 ray" : "");
    }
    if (shown.frames < shown.framesToConverge) {
        return fmt::format("frame {} of {}", shown.frames, shown.framesToConverge);
    }
    return running == Running::continuous ? fmt::format("frame {}", shown.frames) : "finished";
}

}  // namespace reflet
