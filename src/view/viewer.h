// The viewer: a window, a scene, and the user's actions.
#pragma once

#include "device/device.h"
#include "device/presenter.h"
#include "view/canvas.h"
#include "view/clock.h"
#include "view/compare_view.h"
#include "view/controls.h"
#include "view/file_browser.h"
#include "view/render_thread.h"
#include "view/window.h"

#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

/// The device time of a pass over the last frames, milliseconds.
struct PassHistory {
    std::string name;
    float mean = 0.0F;
    uint64_t lastFrame = 0;
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
    struct PictureRect {  // in window units
        vec2 min{0.0F};
        vec2 size{0.0F};
    };

    // viewer.cpp
    void loop();
    void open(const SceneOptions& source, bool restores);
    void showScene(const OpenScene& opened, uint64_t number, const SceneOptions& source, bool restores);
    void openFile(const std::string& file);
    void openJson(const std::filesystem::path& path);
    [[nodiscard]] PictureRect pictureRect() const;
    [[nodiscard]] uvec2 renderSize() const;
    [[nodiscard]] double timeToWait() const;
    [[nodiscard]] bool atRest() const;
    void takeFrames();
    void takeFinished();
    void want();
    void waitForScene();
    void drawWindow();
    void finishPicture();
    void present();
    void noteTimes();
    void tell(const std::string& text) { notice_ = text; }
    void attempt(const std::function<void()>& work);

    // viewer_end.cpp
    void save();
    void checkMessages() const;

    // viewer_actions.cpp
    void applyPresetNamed(const std::string& name);
    [[nodiscard]] std::string commandLine();
    void takeScreenshot(const std::string& file);
    [[nodiscard]] const Scene& scene() const { return *opened_.scene; }
    void pickPixel(uvec2 pixel, bool focuses);
    void focusAt(float distance);
    void focusOnPicked();
    [[nodiscard]] bool isPickedView() const;
    void chooseFalseColorRange();
    void writeStatus();

    // viewer_input.cpp
    void handleKeys();
    void handleControlKey(const KeyPress& press);
    void handleKey(const KeyPress& press);
    void handlePointer();
    void flyByKeys();
    Camera& detachedCamera();
    [[nodiscard]] uvec2 pixelAt(const vec2& mouse) const;

    // viewer_panels.cpp
    void drawUi();
    void drawPanel();
    [[nodiscard]] std::string progressText() const;
    void runPanel();
    void switchesPanel();
    void settingsPanel();
    void lampsPanel();
    void lightPanel();
    void environmentPanel();
    void skyFollowsSun(bool moved);
    void lensPanel();
    void cameraPanel();
    void showPanel();
    void comparePanel();
    void offerSources();
    void explainPanel();
    void pixelPanel();
    void timesPanel();
    void filesPanel();
    void messages();
    void helpOverlay();

    // viewer_overlay.cpp
    void drawDivider();
    void drawHemisphere();
    void drawShadowSearch();
    void drawLegends();
    void drawErrorAt(const vec2& mouse);
    void drawRay();
    [[nodiscard]] vec2 onWindow(const vec2& pixel) const;

    ViewerOptions options_;
    ViewerState state_;
    std::atomic<size_t> messages_ = 0;  ///< of the validation layers, for both devices
    Window window_;
    RenderThread render_;
    gpu::Device device_;  ///< of the window alone
    gpu::Presenter presenter_;
    std::unique_ptr<Canvas> canvas_;
    OpenScene opened_;         ///< no scene while the first one is opened
    uint64_t scene_ = 0;       ///< its number
    RenderThread::State now_;  ///< what the thread published last; `live` is never null
    uint64_t published_ = 0;
    CompareView compare_;
    ControlPlaces places_;
    FileBrowser browser_;
    bool sunMoved_ = false;  ///< since the sky was made

    std::string notice_;   ///< the last completed action
    std::string problem_;  ///< the last failed action; stays until one succeeds
    std::string fileName_;
    std::string filter_;
    std::string openName_;
    std::optional<Picked> picked_;
    uint32_t steps_ = 0;  ///< single frames that were asked for
    enum class Explains : uint8_t { mirror, diffuse, shadow };
    Explains explains_ = Explains::mirror;  ///< what is drawn of the picked pixel
    bool opensPixel_ = false;               ///< opens the pixel panel in the next frame
    std::optional<uvec2> toPick_;
    int redraws_ = 3;  ///< redraws until the user interface has settled
    bool dragsDivider_ = false;
    vec2 pressedAt_{0.0F};
    vec2 pointerBefore_{0.0F};
    bool pressedInPicture_ = false;
    struct Seen {
        View view;
        Settings settings;
        uvec2 size{0};
    };
    std::optional<Seen> seen_;  ///< at the last change
    Clock::time_point lastChange_;
    bool moving_ = false;
    Clock::time_point lastDraw_;
    Clock::time_point lastLoop_;
    double elapsed_ = 0.0;  ///< seconds since the loop's last iteration
    std::deque<float> frameTimes_;
    std::vector<PassHistory> passes_;
    bool wasBusy_ = false;  ///< with a job, whose name was drawn
    uint64_t drawn_ = 0;    ///< window redraws in total
    Clock::time_point lastSave_ = Clock::now();
    std::string saved_;  ///< content of the state file
    bool warnedOfSaving_ = false;
};

}  // namespace reflet
