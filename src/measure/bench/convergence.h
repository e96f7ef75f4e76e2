// Measures how the error of a still view falls with the number of frames. Noise averages out; what remains is bias.
#pragma once

#include "compare/compare.h"
#include "measure/bench/subject.h"
#include "measure/bench/truth.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

struct ConvergencePlan {
    std::vector<uint32_t> frames;  ///< numbers of the frames to compare, ascending; frame 1 has no history
    std::string layer = "final";
    float pixelsPerDegree = 67.0F;
};

/// The error of one frame of a still view.
struct StillError {
    uint32_t frame = 0;
    Difference difference;       ///< with octaves
    double displayedFlip = 0.0;  ///< by displayedFlip()
};

/// Renders the scene's view up to the last frame of the plan, and compares the plan's frames with `truth`. Shows
/// progress. Throws Error.
std::vector<StillError> measureConvergence(gpu::Device& device, const BenchScene& scene, uvec2 size,
                                           const Settings& settings, const Truth& truth, const ConvergencePlan& plan);

}  // namespace reflet
