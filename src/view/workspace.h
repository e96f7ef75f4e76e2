// Data shared by the parts of the window: the state that they change, the open scene, and the last rendered image.
#pragma once

#include "view/controls.h"
#include "view/render_thread.h"
#include "view/window.h"

#include <functional>
#include <string>

namespace reflet {

/// Where the image is in the window, in window units.
struct PictureRect {
    vec2 min{0.0F};
    vec2 size{0.0F};
};

class Workspace {
public:
    /// largestSide: maximum side of an image, pixels.
    Workspace(ViewerState first, const Window& window, uint32_t largestSide);

    ViewerState state;
    OpenScene opened;               ///< no scene while the first one is opened
    uint64_t sceneNumber = 0;       ///< the render thread's number of `opened`
    RenderThread::State published;  ///< last state published by the render thread; `live` is never null
    ControlPlaces places;
    uint32_t steps = 0;  ///< total number of single frames requested

    [[nodiscard]] const Scene& scene() const { return *opened.scene; }
    [[nodiscard]] const RenderedImage& live() const { return *published.live; }
    /// Whether animations are running.
    [[nodiscard]] bool isPlaying() const { return state.plays && state.running != Running::paused; }

    [[nodiscard]] PictureRect pictureRect() const;
    /// Size of the image at rest, pixels.
    [[nodiscard]] uvec2 renderSize() const;

    /// The camera for moving it by hand: detached from its node, if any, at the node's current pose.
    Camera& detachedCamera();
    /// Sets the distance of the plane of focus, metres along the view axis.
    void focusAt(float distance);

    /// Shows a notice about a completed action.
    void tell(const std::string& text) { notice_ = text; }
    /// Runs the work, and shows the problem if it throws.
    void attempt(const std::function<void()>& work);
    [[nodiscard]] const std::string& notice() const { return notice_; }
    [[nodiscard]] const std::string& problem() const { return problem_; }

    /// Number of pending redraws, done even without events.
    [[nodiscard]] int redraws() const { return redraws_; }
    void redraw(int times);
    /// Requests enough redraws for the user interface to settle.
    void redrawUntilSettled();
    void noteRedraw();
    void forgetRedraws() { redraws_ = 0; }

private:
    const Window& window_;
    uint32_t largestSide_;
    std::string notice_;   ///< the last completed action
    std::string problem_;  ///< the last failed action; stays until one succeeds
    int redraws_ = 0;
};

}  // namespace reflet
