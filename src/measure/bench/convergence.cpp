// Measures the error of a still view over frames.
#include "measure/bench/convergence.h"

#include "base/progress.h"
#include "measure/bench/displayed_flip.h"

#include <fmt/format.h>

namespace reflet {

std::vector<StillError> measureConvergence(gpu::Device& device, const BenchScene& scene, uvec2 size,
                                           const Settings& settings, const Truth& truth, const ConvergencePlan& plan) {
    std::vector<StillError> errors;
    if (plan.frames.empty()) {
        return errors;
    }
    CompareOptions options;
    options.pixelsPerDegree = plan.pixelsPerDegree;
    options.referenceName = truth.file;
    options.octaves = true;
    const FloatImage& reference = truth.layers.at(plan.layer);
    Subject subject(device, scene, size, settings);
    Progress progress(scene.name + ", convergence: frame", plan.frames.back());
    uint32_t rendered = 0;
    for (const uint32_t frame : plan.frames) {
        for (; rendered + 1 < frame; ++rendered) {
            subject.render();
            progress.advance();
        }
        const Layers layers = subject.picture({plan.layer, "depth"});
        ++rendered;
        progress.advance();
        const FloatImage& picture = layers.at(plan.layer);
        options.imageName = fmt::format("{} of frame {}", plan.layer, frame);
        errors.push_back({frame, compareImages(picture, reference, options).difference,
                          displayedFlip(picture, reference, layers.at("depth"), settings.tonemap, scene.scene,
                                        plan.pixelsPerDegree)});
    }
    return errors;
}

}  // namespace reflet
