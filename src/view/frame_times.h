// Times of the last frames and of their passes.
#pragma once

#include "view/session.h"

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace reflet {

/// The device time of a pass over the last frames, milliseconds.
struct PassHistory {
    std::string name;
    float mean = 0.0F;
    uint64_t lastFrame = 0;
};

class FrameTimes {
public:
    void note(const RenderedImage& frame);

    /// Times of whole frames, milliseconds, oldest first.
    [[nodiscard]] const std::deque<float>& frames() const { return frames_; }
    /// Times of the last frame's passes.
    [[nodiscard]] const std::vector<PassHistory>& passes() const { return passes_; }

private:
    std::deque<float> frames_;
    std::vector<PassHistory> passes_;
};

}  // namespace reflet
