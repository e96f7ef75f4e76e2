// Runs the temporal antialiasing pass on synthetic images.
#include "pass/temporal_harness.h"

#include "capture/texels.h"
#include "device/device.h"
#include "effects/jitter.h"
#include "pass/test_shaders.h"

namespace reflet::test {

TemporalRun::TemporalRun(gpu::Device& device, uvec2 size, const TemporalSettings& settings)
    : TemporalRun(device, size, size, settings) {}

TemporalRun::TemporalRun(gpu::Device& device, uvec2 size, uvec2 output, const TemporalSettings& settings)
    : frame_(device), size_(size), output_(output), settings_(settings) {
    addPassTestShaders(device);
}

std::vector<vec4> TemporalRun::add(const MadeUpFrame& picture) {
    std::vector<vec4> radiance;
    std::vector<vec4> motion;
    std::vector<vec4> depth;
    std::vector<vec4> roots;
    for (uint32_t i = 0; i < size_.x * size_.y; ++i) {
        const MadeUpPixel p = picture({i % size_.x, i / size_.x});
        radiance.emplace_back(p.radiance, 1.0F);
        motion.emplace_back(p.motion / vec2(size_), 0.0F, 0.0F);
        depth.emplace_back(p.depth);
        roots.emplace_back(glm::sqrt(glm::max(p.baseColor, 0.0F)), 1.0F);
    }
    Filler fill(frame_, size_);
    frame_.begin();
    const gpu::Image shown = fill.colors("radiance", radiance);
    const gpu::Image motions = fill.colors("motion", motion);
    const gpu::Image depths = fill.colors("depth", depth);
    const bool textured = picture({0, 0}).baseColor.x >= 0.0F;
    const gpu::Image baseColor = textured ? fill.colors("base_color", roots) : gpu::Image{};
    ViewParams view{};
    view.exposureChange = 1.0F;
    const vec2 jitter = subpixelJitter(count_);
    view.frame = count_++;
    TemporalInputs in{depths, motions, shown, {}, view, output_, jitter};
    in.baseColor = baseColor;
    const gpu::Readback copy = frame_.readback(temporal(frame_, store_, in, settings_).mean);
    frame_.submit();
    frame_.wait();
    return decodeTexels(VK_FORMAT_R16G16B16A16_SFLOAT, frame_.bytes(copy));
}

}  // namespace reflet::test
