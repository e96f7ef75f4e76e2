// The panel for files: screenshots, saving and opening.
#pragma once

#include "view/actions.h"
#include "view/file_browser.h"
#include "view/scene_opener.h"
#include "view/workspace.h"

#include <string>

namespace reflet {

class FilesPanel {
public:
    FilesPanel(Workspace& work, Actions& actions, SceneOpener& opener)
        : work_(work), actions_(actions), opener_(opener) {}

    void draw();
    /// Draws the list of files while it is open, even if the panels are hidden.
    void drawBrowser();

private:
    void chooseScene();

    Workspace& work_;
    Actions& actions_;
    SceneOpener& opener_;
    FileBrowser browser_;
    std::string name_;  ///< as typed
};

}  // namespace reflet
