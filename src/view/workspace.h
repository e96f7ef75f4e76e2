// What the parts of the window share: the state that they change, the open scene, and the last rendered image.
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
    /// largestSide: of an image, pixels.
    Workspace(ViewerState first, const Window& window, uint32_t largestSide);

    ViewerState state;
    OpenScene opened;               ///< no scene while the first one is opened
    uint64_t sceneNumber = 0;       ///< of `opened`, as the render thread counts
    RenderThread::State published;  ///< what the render thread published last; `live` is never null
    ControlPlaces places;
    uint32_t steps = 0;  ///< single frames that were asked for

    [[nodiscard]] const Scene& scene() const { return *opened.scene; }
    [[nodiscard]] const RenderedImage& live() const { return *published.live; }
    /// Whether animations are running.
    [[nodiscard]] bool isPlaying() const { return state.plays && state.running != Running::paused; }

    [[nodiscard]] PictureRect pictureRect() const;
    /// Of the image at rest, pixels.
    [[nodiscard]] uvec2 renderSize() const;

    /// The camera for moving it by hand: detached from its node, if any, at the node's current pose.
    Camera& detachedCamera();
    /// Puts the plane of focus there, metres along the view axis.
    void focusAt(float distance);

    /// Shows what was done.
    void tell(const std::string& text) { notice_ = text; }
    /// Shows what is wrong if the work throws.
    void attempt(const std::function<void()>& work);
    [[nodiscard]] const std::string& notice() const { return notice_; }
    [[nodiscard]] const std::string& problem() const { return problem_; }

    /// How often the window is drawn again even if nothing happens.
    [[nodiscard]] int redraws() const { return redraws_; }
    void redraw(int times);
    /// Until the user interface has settled.
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
