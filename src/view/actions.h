// Actions of keys and buttons.
#pragma once

#include "view/workspace.h"

#include <string>

namespace reflet {

class Actions {
public:
    Actions(Workspace& work, RenderThread& render, Window& window) : work_(work), render_(render), window_(window) {}

    void applyPresetNamed(const std::string& name);
    void frameAll();
    void resetCamera() { work_.state.view.camera = work_.opened.firstView.camera; }
    void copyCommandLine();
    /// Writes the file in the background; "": the next free name in the current folder. Throws Error.
    void takeScreenshot(const std::string& file);
    void saveSettings(const std::string& file);
    void saveView(const std::string& file);
    void quit() { window_.close(); }

private:
    Workspace& work_;
    RenderThread& render_;
    Window& window_;
};

}  // namespace reflet
