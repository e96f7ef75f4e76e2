// Handles keys and the pointer.
#pragma once

#include "view/actions.h"
#include "view/pixel_inspector.h"
#include "view/workspace.h"

namespace reflet {

class Input {
public:
    Input(Workspace& work, Window& window, Actions& actions, PixelInspector& pixel)
        : work_(work), window_(window), actions_(actions), pixel_(pixel) {}

    void handlePointer();
    void handleKeys();
    /// Moves the camera by the keys that are held. elapsed: seconds since the last call.
    void fly(double elapsed);

private:
    void handleControlKey(int key);
    void handleKey(int key);
    void startDrag();
    void dragCamera(const vec2& moved);
    [[nodiscard]] bool isInPicture(const vec2& at) const;
    [[nodiscard]] uvec2 pixelAt(const vec2& mouse) const;

    Workspace& work_;
    Window& window_;
    Actions& actions_;
    PixelInspector& pixel_;
    bool dragsDivider_ = false;
    vec2 pressedAt_{0.0F};
    vec2 pointerBefore_{0.0F};
    bool pressedInPicture_ = false;
};

}  // namespace reflet
