// Draws over the image: the divider, the picked pixel's rays, legends, the list of keys.
#pragma once

#include "view/compare_view.h"
#include "view/pixel_inspector.h"
#include "view/workspace.h"

namespace reflet {

class Overlay {
public:
    Overlay(Workspace& work, const Window& window, const CompareView& compare, const PixelInspector& pixel)
        : work_(work), window_(window), compare_(compare), pixel_(pixel) {}

    void draw();

private:
    void drawDivider() const;
    void drawErrorAt(const vec2& mouse) const;
    void drawSourceLegend() const;
    void drawErrorLegend() const;
    void drawSwitchedOff() const;
    void drawKeys();

    Workspace& work_;
    const Window& window_;
    const CompareView& compare_;
    const PixelInspector& pixel_;
};

}  // namespace reflet
