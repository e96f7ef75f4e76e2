// Renders a scene: owns everything that outlives a frame, including the last view for motion vectors.
#pragma once

#include "device/frame.h"
#include "renderer/environment_maps/environment_maps.h"
#include "renderer/frame.h"
#include "renderer/gpu_scene.h"
#include "renderer/light_change.h"
#include "renderer/pre_exposure.h"
#include "renderer/probe/capture_probe.h"
#include "renderer/view_params.h"
#include "scene/image_suns.h"
#include "scene/pose.h"

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace reflet {

class Renderer {
public:
    /// The scene must outlive the renderer: data for ray tracing and probes is made from it on first use.
    Renderer(gpu::Device& device, const Scene& scene, const std::function<void(const std::string&)>& warn);
    Renderer(gpu::Device& device, const Scene&& scene, const std::function<void(const std::string&)>& warn) = delete;

    /// Renders one frame; `after` may record more passes (read-backs). Returns when the device is done. Motion vectors
    /// are relative to the last frame, whatever its view and time were; zero in the first frame.
    FrameImages render(const View& asked, uvec2 size, uint32_t seed, const Settings& settings,
                       const std::function<void(gpu::Frame&, const FrameImages&)>& after = {});

    /// From the next frame on, calls `stop` between passes while a frame is rendered. If it returns true, render()
    /// throws gpu::FrameStopped; then restart() must be called. Empty: frames are not stopped. Captures of probes and
    /// other preparations are always completed.
    void stopBetweenPasses(std::function<bool()> stop) { stop_ = std::move(stop); }

    /// From the next frame on, motion blur shows only camera motion from `before`, and no other motion; nullopt: all
    /// motion since the last frame. For stills that are frames of a film.
    void blurSince(const std::optional<Camera>& before) { blurSince_ = before; }

    /// Discards all history: the next frame is rendered like a renderer's first, with the noise pattern of frame
    /// `frameNumber`.
    void restart(uint32_t frameNumber);

    [[nodiscard]] const gpu::Frame& frame() const { return frame_; }
    /// Enables frame().listing() from the next frame on.
    void listPasses() { frame_.listPasses(); }
    /// For tests (gpu::Recorder::poisonTransients).
    void poisonTransients(bool poisons) { frame_.poisonTransients(poisons); }
    /// For tests (gpu::Recorder::orderPasses).
    void orderPasses(gpu::PassOrder order) { frame_.orderPasses(order); }

private:
    /// Poses the scene at the time of the view.
    void pose(const View& view);
    /// Lamps and emitters of the scene, with the view's radii, without those that the view switches off.
    [[nodiscard]] LampBlock ownLamps(const View& view, const Settings& settings) const;
    /// Chooses the lamps that cast shadows. Prints each warning once.
    LampShadows planLamps(LampBlock& lamps, const View& view, const ShadowSettings& settings);
    void addReflectedSuns(LampBlock& lamps, const View& view, const Settings& settings) const;
    /// Multiplies the lights by the pre-exposure, and returns it.
    float preExpose(LampBlock& lamps, View& view);
    /// Discards all images with light of earlier frames.
    void forgetLight();

    /// The BVH for ray tracing, if the settings need one.
    const TracedScene* tracedScene(const Settings& settings);
    /// The view's probes, or automatically placed ones if it lists none.
    const std::vector<Probe>& probesOf(const View& view, const ProbesSettings& settings);
    /// The live camera images for the frame of this view.
    std::vector<LiveView> liveViews(const ViewParams& view);
    /// The view with the suns of its environment's image as lights. others: suns besides the view's main sun.
    View withSuns(const View& view, const Settings& settings, std::vector<Lamp>& others);
    /// The value of FrameInputs::cameraBefore. startsAgain: animations have looped, so objects jump back.
    [[nodiscard]] std::optional<mat4> cameraBefore(const ViewParams& view, uvec2 size, const Settings& settings,
                                                   bool startsAgain) const;
    /// lit: the view with its suns as lights, whose environment has none.
    FrameBackground backgroundOf(const View& view, const View& lit);
    std::vector<Mirror> planMirrors(const View& view, const ViewParams& params, const Settings& settings);
    void warnOnce(const std::string& text);

    gpu::Frame frame_;
    std::function<bool()> stop_;
    const Scene& source_;
    GpuScene scene_;
    std::optional<TracedScene> traced_;
    uint32_t tracedTextureSize_ = 0;
    std::vector<FlatPiece> flatPieces_;  ///< at time 0
    std::vector<FlatPiece> posedPieces_;
    std::optional<ScenePose> pose_;  ///< pose of the last frame; none before the first one, and for static scenes
    std::optional<double> tracedTime_;
    FrameStore store_;
    gpu::KeptImage ggxTable_{"ggx_table"};
    gpu::Buffer blueNoise_;
    EnvironmentMaps environment_;
    EnvironmentMaps background_{/*prefilters=*/false};
    std::shared_ptr<const FloatImage> sunsFrom_;  ///< image of the environment
    ImageSuns suns_;
    std::shared_ptr<const FloatImage> blurredFrom_;  ///< image of the environment
    std::shared_ptr<const FloatImage> blurred_;
    VolumeFinder volumes_;
    Probes probes_;
    RadianceCache cache_;
    std::vector<Probe> placed_;
    std::optional<uint32_t> placedCount_;  ///< requested number of placed_
    std::function<void(const std::string&)> warn_;
    std::set<std::string> warned_;
    ViewParams nextParams(const View& view, uvec2 size, uint32_t seed, const Settings& settings);
    /// Sets framesBefore_.
    void countFramesBefore(const View& view, const ViewParams& params, const Settings& settings);
    struct Asked {
        View view;
        Settings settings;
        vec2 size;
        uint32_t seed;
    };

    std::optional<Asked> asked_;  ///< inputs of the last frame
    uint32_t framesBefore_ = 0;   ///< consecutive frames before this one with unchanged view and settings
    LightChange lightChange_;
    PreExposure preExposure_;
    std::optional<mat4> previousWorldToClip_;  ///< without jitter
    vec2 previousPlace_{0.0F};                 ///< subpixel jitter of the last frame, pixels
    std::optional<Camera> blurSince_;
    std::optional<double> previousTime_;  ///< requested time of the last frame, not looped [s]
    uint32_t frameNumber_ = 0;
};

}  // namespace reflet
