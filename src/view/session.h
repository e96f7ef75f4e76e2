// One open scene: renders it according to the state, and tracks when the image has converged. Used only by the render
// thread; the window has copies of its output.
#pragma once

#include "capture/show.h"
#include "renderer/renderer.h"
#include "view/picked.h"
#include "view/viewer_state.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// The display image of a show's values: tone mapped, as by --show, or in false colours.
Bitmap shownPicture(const ViewerState& state, const TonemapSettings& tonemap, const FloatImage& values);

/// Copies of the results of a session's last frame, for the window's thread.
struct RenderedImage {
    std::shared_ptr<const Bitmap> picture;     ///< null before the first frame, or if there is a `problem`
    std::shared_ptr<const FloatImage> values;  ///< values of the show; null if they were not kept
    std::string problem;                       ///< why the show is not available
    TonemapSettings tonemap;        ///< displays other pictures with this frame's exposure, including the automatic one
    std::optional<float> exposure;  ///< automatic exposure [stops]
    ViewParams view{};              ///< view of the frame
    uvec2 size{0};                  ///< rendered size
    uint32_t frames = 0;            ///< number of frames since the last change
    uint32_t framesToConverge = 0;  ///< number of frames until the image has converged
    uint64_t changes = 0;           ///< number of changes of view, settings or size so far
    uint64_t rendered = 0;          ///< number of frames in total
    std::vector<gpu::PassTime> passes;
    double milliseconds = 0.0;  ///< from the frame's submission to its completion
};

/// A scene that was opened.
struct OpenScene {
    std::shared_ptr<const Scene> scene;
    View firstView;  ///< given by the scene and the command line

    /// Whether `reflet render` at this size gives the state's view without a view file: the view is unchanged, and the
    /// camera was not framed for another size.
    [[nodiscard]] bool isDefaultView(const ViewerState& state, uvec2 size) const;
};

class Session {
public:
    /// Opens the scene of the options. Throws Error or UsageError.
    Session(gpu::Device& device, const SceneOptions& source);
    /// Another session of the same scene.
    Session(gpu::Device& device, const Session& other);

    /// Whether another frame would change the image at this size.
    [[nodiscard]] bool wantsFrame(const ViewerState& state, uvec2 size) const;
    /// Renders one frame and its display image. keepValues: shown().values will be needed. stop: polled during the
    /// frame if the device is slow; if it returns true, the frame and all history are dropped, and the call returns
    /// false.
    bool render(const ViewerState& state, uvec2 size, bool keepValues, const std::function<bool()>& stop);
    /// Resets the history, after a change outside the state, such as of a shader.
    void resetHistory();
    /// Redraws the display image of the same frame, with other false colours.
    void refreshPicture(const ViewerState& state);

    [[nodiscard]] const RenderedImage& shown() const { return shown_; }
    [[nodiscard]] const OpenScene& opened() const { return opened_; }

    /// Writes the same file as `reflet render` for this state, with its number of frames. Throws Error.
    void screenshot(const ViewerState& state, uvec2 size, const std::string& file);

    /// Renders a frame, and returns the values of its render targets at the pixel and the path of the pixel's mirror
    /// ray. Render targets that these settings do not produce are left out.
    Picked pick(const ViewerState& state, uvec2 size, uvec2 pixel);

private:
    struct Request {
        View view;
        Settings settings;
        uvec2 size;
        std::string show;
    };

    FrameImages renderFrame(const ViewerState& state, const View& view, uvec2 size, const Settings& settings,
                            const std::function<void(gpu::Frame&, const FrameImages&)>& after);

    gpu::Device& device_;
    OpenScene opened_;
    Renderer renderer_;
    RenderedImage shown_;
    std::optional<Request> last_;
};

/// The settings of a frame: the state's, plus those that its show needs.
Settings renderedSettings(const ViewerState& state);

}  // namespace reflet
