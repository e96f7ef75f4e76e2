// One open scene: renders it as the state says, and knows when the picture has come to rest.
#pragma once

#include "apps/show.h"
#include "render/bounce/record_ray.h"
#include "render/renderer.h"
#include "view/viewer_state.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// Values of the picked pixel in one image of the frame.
struct PickedValues {
    std::string name;
    std::vector<std::string> channels;
    std::vector<float> values;
};

struct Picked {
    uvec2 pixel{0};
    std::vector<PickedValues> values;
    std::optional<RecordedRay> ray;  ///< none where the pixel shows no surface
    ViewParams view{};               ///< that it was picked in
    uint64_t change = 0;             ///< Session::changes() then
};

/// The picture of values that a show has: tone mapped, as --show makes it, or in false colours.
Bitmap shownPicture(const ViewerState& state, const FloatImage& values);

class Session {
public:
    /// Opens what state.source names, and sets the state's view from it. Throws Error or UsageError: then nothing of
    /// the state has changed.
    Session(gpu::Device& device, ViewerState& state);
    /// The same scene once more.
    Session(gpu::Device& device, const Session& other);

    /// A picture of this size is needed: whether another frame would change it.
    [[nodiscard]] bool wantsFrame(const ViewerState& state, uvec2 size) const;
    /// Renders one frame, and what it shows. keepValues: shownValues() will be asked for.
    void render(const ViewerState& state, uvec2 size, bool keepValues);
    /// History is forgotten: something changed that the state does not tell (a shader, say).
    void startAnew();

    /// What the window is to show of the last frame; none before the first one, or where showProblem() says why.
    [[nodiscard]] gpu::Image picture() const { return picture_; }
    [[nodiscard]] const std::string& showProblem() const { return problem_; }
    /// The values of the show; nothing where they were not kept.
    [[nodiscard]] const std::shared_ptr<const FloatImage>& shownValues() const { return values_; }
    /// Makes the picture of the same frame again, with other false colours.
    void refreshPicture(const ViewerState& state);

    [[nodiscard]] const gpu::Frame& frame() const { return renderer_.frame(); }
    [[nodiscard]] uvec2 size() const { return size_; }
    [[nodiscard]] uint32_t frames() const { return frames_; }
    /// How often something that is rendered was another than before.
    [[nodiscard]] uint64_t changes() const { return changes_; }
    /// Of the last frame.
    [[nodiscard]] const ViewParams& view() const { return params_; }
    [[nodiscard]] const Scene& scene() const { return *scene_; }
    [[nodiscard]] const std::shared_ptr<const Scene>& sharedScene() const { return scene_; }
    [[nodiscard]] const View& firstView() const { return firstView_; }

    /// Writes what `reflet render` writes for this state, with the frames that it takes. Throws Error.
    void screenshot(const ViewerState& state, uvec2 size, const std::string& file);

    /// Renders a frame, and says what its images hold at the pixel and which way the pixel's mirror ray takes. Images
    /// that these settings do not make are left out.
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
    gpu::Image picture_;
    gpu::Texture uploaded_;
    std::string problem_;
    std::shared_ptr<const FloatImage> values_;
    ViewParams params_{};
    uvec2 size_{0};
    std::optional<Asked> asked_;
    uint64_t changes_ = 0;
    uint32_t frames_ = 0;  ///< since something changed
};

/// The settings that a frame is rendered with: what the state has, and what its show needs.
Settings renderedSettings(const ViewerState& state);

/// Frames after which the picture has come to rest.
uint32_t framesToRest(const ViewerState& state);

/// RGBA8 texture of a picture of 3 or 4 channels.
gpu::Texture uploadPicture(gpu::Device& device, const Bitmap& bitmap, const std::string& name);

}  // namespace reflet
