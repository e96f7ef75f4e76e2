// Renders a scene: holds what lives longer than a frame, and keeps the last view for motion.
#pragma once

#include "gpu/frame.h"
#include "render/frame.h"
#include "render/gpu_scene.h"
#include "scene/scene.h"

#include <functional>
#include <optional>
#include <set>
#include <string>

namespace reflet {

/// Throws Error for what a view can say and this version cannot render: an environment image.
void checkCanRender(const View& view);

class Renderer {
public:
    Renderer(gpu::Device& device, const Scene& scene, const std::function<void(const std::string&)>& warn);

    /// Records one frame; `after` may record more (read-backs). Returns when the device is done. Throws Error where
    /// checkCanRender does.
    FrameImages render(const View& view, uvec2 size, uint32_t seed, const Settings& settings,
                       const std::function<void(gpu::Frame&, const FrameImages&)>& after = {});

    [[nodiscard]] const gpu::Frame& frame() const { return frame_; }

private:
    /// Radii that the view gives; who casts a shadow. Warns, but only once of the same.
    LampShadows planLamps(LampBlock& lamps, const View& view, const ShadowSettings& settings);

    std::vector<Mirror> planMirrors(const View& view, const ViewParams& params, const Settings& settings);
    void warnOnce(const std::string& text);

    gpu::Frame frame_;
    GpuScene scene_;
    std::vector<FlatPiece> flatPieces_;
    gpu::Texture ggxTable_;
    gpu::Buffer blueNoise_;
    std::function<void(const std::string&)> warn_;
    std::set<std::string> warned_;
    std::optional<mat4> previousWorldToClip_;
    uint32_t frameNumber_ = 0;
};

/// The camera as passes see it. previousWorldToClip is set to the camera's own.
ViewParams makeViewParams(const Camera& camera, uvec2 size, uint32_t frame, uint32_t seed);

}  // namespace reflet
