// Collects times of frames.
#include "view/frame_times.h"

#include <algorithm>

namespace reflet {

namespace {

constexpr size_t keptFrames = 160;
constexpr float weight = 0.1F;  // of the new frame in a pass's mean

}  // namespace

void FrameTimes::note(const RenderedImage& frame) {
    for (const gpu::PassTime& pass : frame.passes) {
        const auto known = std::ranges::find(passes_, pass.name, &PassHistory::name);
        const auto ms = static_cast<float>(pass.ms);
        if (known == passes_.end()) {
            passes_.push_back({pass.name, ms, frame.rendered});
        } else {
            known->mean = known->lastFrame + 1 == frame.rendered ? glm::mix(known->mean, ms, weight) : ms;
            known->lastFrame = frame.rendered;
        }
    }
    std::erase_if(passes_, [&](const PassHistory& pass) { return pass.lastFrame != frame.rendered; });
    frames_.push_back(static_cast<float>(frame.milliseconds));
    if (frames_.size() > keptFrames) {
        frames_.pop_front();
    }
}

}  // namespace reflet
