// Runs the temporal antialiasing pass on synthetic images.
#pragma once

#include "device/frame.h"
#include "effects/temporal/temporal.h"

#include <functional>
#include <vector>

namespace reflet::test {

/// What one frame shows at each pixel.
struct MadeUpPixel {
    vec3 radiance{0.0F};
    vec2 motion{0.0F};  ///< pixels
    float depth = 0.5F;
};
using MadeUpFrame = std::function<MadeUpPixel(uvec2 pixel)>;

class TemporalRun {
public:
    TemporalRun(gpu::Device& device, uvec2 size, const TemporalSettings& settings = {});

    /// Radiance and number of frames after this frame, by rows.
    std::vector<vec4> add(const MadeUpFrame& picture);

    /// Frames so far.
    [[nodiscard]] uint32_t count() const { return count_; }

private:
    gpu::Frame frame_;
    TemporalStore store_;
    uvec2 size_;
    TemporalSettings settings_;
    uint32_t count_ = 0;
};

}  // namespace reflet::test
