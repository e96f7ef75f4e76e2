// The panel for sun, lamps, environment and background.
#pragma once

#include "view/workspace.h"

namespace reflet {

class LightPanel {
public:
    explicit LightPanel(Workspace& work) : work_(work) {}

    void draw();

private:
    void sun();
    void skyFollowsSun(bool moved);
    void lamps();
    void environment();
    void background();

    Workspace& work_;
    bool sunMoved_ = false;  ///< the sun has moved since the sky was generated
};

}  // namespace reflet
