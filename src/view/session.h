// One open scene: renders it according to the state, and tracks when the image has converged.
#pragma once

#include "capture/show.h"
#include "effects/lobe/record_ray.h"
#include "renderer/renderer.h"
#include "view/viewer_state.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// Values of the picked pixel in one render target.
struct PickedValues {
    std::string name;
    std::vector<std::string> channels;
    std::vector<float> values;
};

struct Picked {
    uvec2 pixel{0};
    std::vector<PickedValues> values;
    std::optional<RecordedRay> ray;  ///< none where the pixel shows no surface
    ViewParams view{};               ///< at the time of the pick
    uint64_t change = 0;             ///< Session::changes() at the time of the pick
};

/// The display image of a show's values: tone mapped, as by --show, or in false colours.
Bitmap shownPicture(const ViewerState& state, const TonemapSettings& tonemap, const FloatImage& values);

class Session {
public:
    /// Opens the scene of state.source and sets the state's view from it. Throws Error or UsageError; the state is
    /// unchanged then.
    Session(gpu::Device& device, ViewerState& state);
    /// Another session of the same scene.
    Session(gpu::Device& device, const Session& other);

    /// Frames after which the image has converged.
    [[nodiscard]] uint32_t framesToConverge(const ViewerState& state) const;
    /// Whether another frame would change the image at this size.
    [[nodiscard]] bool wantsFrame(const ViewerState& state, uvec2 size) const;
    /// Renders one frame and its display image. keepValues: shownValues() will be needed.
    void render(const ViewerState& state, uvec2 size, bool keepValues);
    /// Resets the history: something outside the state changed, such as a shader.
    void resetHistory();

    /// The display image of the last frame; none before the first frame, or if showProblem() gives a reason.
    [[nodiscard]] gpu::Image picture() const { return picture_; }
    [[nodiscard]] const std::string& showProblem() const { return problem_; }
    /// The values of the show; null if they were not kept.
    [[nodiscard]] const std::shared_ptr<const FloatImage>& shownValues() const { return values_; }
    /// Settings that show other pictures with the exposure of the last frame, the automatic one included.
    [[nodiscard]] TonemapSettings shownTonemap(const ViewerState& state) const;
    /// Redraws the display image of the same frame, with other false colours.
    void refreshPicture(const ViewerState& state);

    [[nodiscard]] const gpu::Frame& frame() const { return renderer_.frame(); }
    [[nodiscard]] uvec2 size() const { return size_; }
    [[nodiscard]] uint32_t frames() const { return frames_; }
    /// Number of changes of view, settings or size so far.
    [[nodiscard]] uint64_t changes() const { return changes_; }
    /// The view parameters of the last frame.
    [[nodiscard]] const ViewParams& view() const { return params_; }
    /// Automatic exposure of the last frame [stops], if it has one.
    [[nodiscard]] std::optional<float> exposure() const { return exposure_; }
    [[nodiscard]] const Scene& scene() const { return *scene_; }
    [[nodiscard]] const std::shared_ptr<const Scene>& sharedScene() const { return scene_; }
    [[nodiscard]] const View& firstView() const { return firstView_; }

    /// Whether `reflet render` at this size has the state's view without a view file: nothing was changed, and no
    /// camera was framed for another size.
    [[nodiscard]] bool isDefaultView(const ViewerState& state, uvec2 size) const;

    /// Writes the same file as `reflet render` for this state, with its number of frames. Throws Error.
    void screenshot(const ViewerState& state, uvec2 size, const std::string& file);

    /// Renders a frame, and returns the values of its render targets at the pixel and the path of the pixel's mirror
    /// ray. Render targets that these settings do not produce are left out.
    Picked pick(const ViewerState& state, uvec2 size, uvec2 pixel);

private:
    struct Asked {
        View view;
        Settings settings;
        uvec2 size;
    };

    FrameImages renderFrame(const ViewerState& state, const View& view, uvec2 size, const Settings& settings,
                            const std::function<void(gpu::Frame&, const FrameImages&)>& after);

    gpu::Device& device_;
    std::shared_ptr<const Scene> scene_;
    View firstView_;
    Renderer renderer_;
    RecordRayStore recordRay_;
    gpu::Image picture_;
    gpu::Texture uploaded_;
    std::string problem_;
    std::shared_ptr<const FloatImage> values_;
    std::optional<float> exposure_;  ///< automatic, of the last frame [stops]
    ViewParams params_{};
    uvec2 size_{0};
    std::optional<Asked> asked_;
    uint64_t changes_ = 0;
    uint32_t frames_ = 0;  ///< since the last change
};

/// The settings of a frame: those of the state, plus what its show needs.
Settings renderedSettings(const ViewerState& state);

/// RGBA8 texture of an image with 3 or 4 channels.
gpu::Texture uploadPicture(gpu::Device& device, const Bitmap& bitmap, const std::string& name);

}  // namespace reflet
