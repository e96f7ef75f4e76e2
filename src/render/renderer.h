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
    /// The scene must outlive the renderer: what only rays need is made of it when it is first needed.
    Renderer(gpu::Device& device, const Scene& scene, const std::function<void(const std::string&)>& warn);

    /// Records one frame; `after` may record more (read-backs). Returns when the device is done. Throws Error where
    /// checkCanRender does.
    FrameImages render(const View& view, uvec2 size, uint32_t seed, const Settings& settings,
                       const std::function<void(gpu::Frame&, const FrameImages&)>& after = {});

    [[nodiscard]] const gpu::Frame& frame() const { return frame_; }

private:
    /// Radii that the view gives; who casts a shadow. Warns, but only once of the same.
    LampShadows planLamps(LampBlock& lamps, const View& view, const ShadowSettings& settings);

    /// What rays are traced through; nothing where the settings trace none.
    const TracedScene* tracedScene(const Settings& settings);

    gpu::Frame frame_;
    const Scene& source_;
    GpuScene scene_;
    std::optional<TracedScene> traced_;
    uint32_t tracedTextureSize_ = 0;
    gpu::Texture ggxTable_;
    gpu::Buffer blueNoise_;
    std::function<void(const std::string&)> warn_;
    std::set<std::string> warned_;
    /// In which the picture has been what it is asked to be now: how many there were.
    uint32_t countFramesBefore(const View& view, const ViewParams& params, const Settings& settings);
    struct Asked {
        View view;
        Settings settings;
        vec2 size;
        uint32_t seed;
    };

    std::optional<Asked> asked_;  ///< of the last frame
    uint32_t framesBefore_ = 0;
    std::optional<mat4> previousWorldToClip_;
    uint32_t frameNumber_ = 0;
};

/// The camera as passes see it. previousWorldToClip is set to the camera's own.
ViewParams makeViewParams(const Camera& camera, uvec2 size, uint32_t frame, uint32_t seed);

}  // namespace reflet
