// The panel for the camera and its lens.
#pragma once

#include "view/actions.h"
#include "view/workspace.h"

namespace reflet {

class CameraPanel {
public:
    CameraPanel(Workspace& work, Actions& actions) : work_(work), actions_(actions) {}

    void draw();

private:
    void lens();

    Workspace& work_;
    Actions& actions_;
};

}  // namespace reflet
