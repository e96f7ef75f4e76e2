// The panels on the left.
#pragma once

#include "view/actions.h"
#include "view/camera_panel.h"
#include "view/compare_panel.h"
#include "view/files_panel.h"
#include "view/frame_times.h"
#include "view/light_panel.h"
#include "view/pixel_inspector.h"

#include <functional>
#include <string>

namespace reflet {

class Panels {
public:
    /// Objects that the panels show and change besides the state.
    struct Parts {
        const Window& window;
        const RenderThread& render;
        Actions& actions;
        SceneOpener& opener;
        PixelInspector& pixel;
        const CompareView& compare;
        const FrameTimes& times;
    };

    Panels(Workspace& work, const Parts& parts);

    void draw();
    /// Draws the list of files while it is open, even if the panels are hidden.
    void drawBrowser() { files_.drawBrowser(); }

private:
    struct Folding {
        bool startsOpen = false;
        bool comesIntoView = false;
    };

    void section(const char* title, const Folding& how, const std::function<void()>& panel);
    void runPanel();
    void timePanel();
    void switchesPanel();
    void messages();
    void settingsPanel();
    void showPanel();
    void fitFalseColorRange();
    void timesPanel();
    void passTable();

    Workspace& work_;
    const Window& window_;
    const RenderThread& render_;
    Actions& actions_;
    PixelInspector& pixel_;
    const FrameTimes& times_;
    LightPanel light_;
    CameraPanel camera_;
    ComparePanel compare_;
    FilesPanel files_;
    std::string filter_;  ///< search text of the settings panel
};

}  // namespace reflet
