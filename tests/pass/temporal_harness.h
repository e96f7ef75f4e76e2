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
    vec2 motion{0.0F};  ///< pixels of the frame
    float depth = 0.5F;
    vec3 baseColor{-1.0F};  ///< linear; below 0 in the first pixel: none is given
};
using MadeUpFrame = std::function<MadeUpPixel(uvec2 pixel)>;

class TemporalRun {
public:
    /// Frames of `size` pixels.
    TemporalRun(gpu::Device& device, uvec2 size, const TemporalSettings& settings = {});
    /// Pictures of `output` pixels from frames of `size`, whose jitter is subpixelJitter(count()).
    TemporalRun(gpu::Device& device, uvec2 size, uvec2 output, const TemporalSettings& settings = {});

    /// Radiance and number of frames after this frame, by rows of the picture.
    std::vector<vec4> add(const MadeUpFrame& picture);

    /// Frames so far.
    [[nodiscard]] uint32_t count() const { return count_; }

private:
    gpu::Frame frame_;
    TemporalStore store_;
    uvec2 size_;
    uvec2 output_;
    TemporalSettings settings_;
    uint32_t count_ = 0;
};

}  // namespace reflet::test
