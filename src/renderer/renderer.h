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

    /// Records one frame; `after` may record more (read-backs). Returns when the device is done. Motion is that since
    /// the last frame, whatever its view and time were; in the first frame there is none.
    FrameImages render(const View& asked, uvec2 size, uint32_t seed, const Settings& settings,
                       const std::function<void(gpu::Frame&, const FrameImages&)>& after = {});

    /// From the next frame on, asks `stop` between passes while a frame is computed. If it returns true, render()
    /// throws gpu::FrameStopped; restart() must be called then. Empty: frames are not stopped. Captures of probes and
    /// other preparations are always completed.
    void stopBetweenPasses(std::function<bool()> stop) { stop_ = std::move(stop); }

    /// From the next frame on, motion blur is that of a camera that came from `before`, and of nothing else that moves;
    /// nullopt: of all motion since the last frame. For frames at rest that stand for one of a film.
    void blurSince(const std::optional<Camera>& before) { blurSince_ = before; }

    /// Discards all history: the next frame is rendered like a renderer's first, with the noise of the frame of this
    /// number.
    void restart(uint32_t frameNumber);

    [[nodiscard]] const gpu::Frame& frame() const { return frame_; }
    /// From the next frame on, frame().listing() tells the passes.
    void listPasses() { frame_.listPasses(); }
    /// For tests (gpu::Recorder::poisonTransients).
    void poisonTransients(bool poisons) { frame_.poisonTransients(poisons); }
    /// For tests (gpu::Recorder::orderPasses).
    void orderPasses(gpu::PassOrder order) { frame_.orderPasses(order); }

private:
    /// Poses the scene at the time of the view.
    void pose(const View& view);
    /// Lamps and emitters of the scene, with the radii of the view and without those that it switches off.
    [[nodiscard]] LampBlock ownLamps(const View& view, const Settings& settings) const;
    /// Chooses the lamps that cast shadows. Gives each warning once.
    LampShadows planLamps(LampBlock& lamps, const View& view, const ShadowSettings& settings);
    void addReflectedSuns(LampBlock& lamps, const View& view, const Settings& settings) const;
    /// Multiplies the lights by the pre-exposure, and returns it.
    float preExpose(LampBlock& lamps, View& view);
    /// Discards all images of light of earlier frames.
    void forgetLight();

    /// The BVH for ray tracing, if the settings need one.
    const TracedScene* tracedScene(const Settings& settings);
    /// The view's probes, or automatically placed ones if it lists none.
    const std::vector<Probe>& probesOf(const View& view, const ProbesSettings& settings);
    /// The live camera images for the frame of this view.
    std::vector<LiveView> liveViews(const ViewParams& view);
    /// The view with the suns of its environment's image as lights. others: of these, what is not the view's sun.
    View withSuns(const View& view, const Settings& settings, std::vector<Lamp>& others);
    /// Of FrameInputs. startsAgain: animations do, so objects jump back.
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
    std::optional<ScenePose> pose_;  ///< of the last frame; none before the first one, and of scenes that stand still
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
    std::optional<uint32_t> placedCount_;  ///< that placed_ were asked for
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

    std::optional<Asked> asked_;  ///< of the last frame
    uint32_t framesBefore_ = 0;   ///< consecutive frames before this one with unchanged view and settings
    LightChange lightChange_;
    PreExposure preExposure_;
    std::optional<mat4> previousWorldToClip_;  ///< without jitter
    vec2 previousPlace_{0.0F};                 ///< in the pixel, that the last frame looked through
    std::optional<Camera> blurSince_;
    std::optional<double> previousTime_;  ///< that the last frame was asked for, not looped [s]
    uint32_t frameNumber_ = 0;
};

}  // namespace reflet
