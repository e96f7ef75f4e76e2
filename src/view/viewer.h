// The viewer: a window, a scene, and the main loop that updates both.
#pragma once

#include "device/device.h"
#include "device/presenter.h"
#include "view/actions.h"
#include "view/canvas.h"
#include "view/clock.h"
#include "view/compare_view.h"
#include "view/frame_times.h"
#include "view/input.h"
#include "view/overlay.h"
#include "view/panels.h"
#include "view/pixel_inspector.h"
#include "view/render_thread.h"
#include "view/scene_opener.h"
#include "view/state_saver.h"
#include "view/window.h"
#include "view/workspace.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>

namespace reflet {

struct ViewerOptions {
    SceneOptions scene;
    std::string device;
    bool fresh = false;         ///< starts without the scene's saved state, which is overwritten at the end
    std::string status;         ///< file that describes the window's content, for scripts; empty: none
    std::string pick;           ///< "X,Y": a pixel to pick once the image has converged
    std::string windowPicture;  ///< PNG of the window once converged, after which the program exits; empty: none
    std::string shaders;        ///< source folder whose shaders are watched; empty: the program's own
    bool validate = false;
};

class Viewer {
public:
    /// Opens the window and the scene. Throws Error or UsageError.
    explicit Viewer(const ViewerOptions& options);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// Runs until the window is closed. Throws Error if the device or the surface is lost, after saving the state.
    void run();

private:
    Viewer(const ViewerOptions& options, const ViewerState& first);

    void loop();
    void waitForEvents();
    void update();
    bool updateComparison();
    [[nodiscard]] double timeToWait() const;
    [[nodiscard]] bool atRest() const;
    void takeFrames();
    void takeFinished();
    void want();
    void waitForScene();
    void drawWindow();
    void finishPicture();
    void present();
    void writeStatus() const;
    void forgetScene();
    void checkMessages() const;

    ViewerOptions options_;
    std::atomic<size_t> messages_ = 0;  ///< number of validation messages, of both devices
    Window window_;
    RenderThread render_;
    gpu::Device device_;  ///< only for the window
    gpu::Presenter presenter_;
    std::unique_ptr<Canvas> canvas_;
    Workspace work_;
    CompareView compare_;
    FrameTimes times_;
    StateSaver saver_;
    SceneOpener opener_;
    PixelInspector pixel_;
    Actions actions_;
    Input input_;
    Panels panels_;
    Overlay overlay_;

    uint64_t published_ = 0;  ///< RenderThread::published at the time its state was taken
    std::optional<uvec2> toPick_;
    struct Seen {
        View view;
        Settings settings;
        uvec2 size{0};
    };
    std::optional<Seen> seen_;  ///< values at the last change
    Clock::time_point lastChange_;
    bool moving_ = false;
    Clock::time_point lastDraw_;
    Clock::time_point lastLoop_;
    double elapsed_ = 0.0;  ///< seconds since the loop's last iteration
    bool wasBusy_ = false;  ///< a job was running, and its name was drawn
    uint64_t drawn_ = 0;    ///< window redraws in total
};

}  // namespace reflet
