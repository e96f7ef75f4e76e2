// Inspects a pixel: its values, and the rays behind them, in a panel and over the image.
#pragma once

#include "view/workspace.h"

#include <optional>
#include <utility>

namespace reflet {

class PixelInspector {
public:
    PixelInspector(Workspace& work, RenderThread& render) : work_(work), render_(render) {}

    /// Reads the pixel in the background. focuses: also focuses the lens there.
    void pick(uvec2 pixel, bool focuses);
    void forget() { picked_.reset(); }
    /// Picks the same pixel again if settings or light have changed since, but not the view. Returns whether it did.
    bool update();

    [[nodiscard]] const std::optional<Picked>& picked() const { return picked_; }

    /// Opens the panel the next time it is drawn.
    void openPanel() { opensPanel_ = true; }
    [[nodiscard]] bool takeOpensPanel() { return std::exchange(opensPanel_, false); }
    void drawPanel();

    void drawOverlay() const;

private:
    enum class Explains : uint8_t { mirror, diffuse, shadow };

    void focusOnPicked();
    [[nodiscard]] bool isPickedView() const;

    // pixel_panel.cpp
    void headPanel();
    void offerSources();
    void explainPanel();
    void explainShadow() const;

    // pixel_overlay.cpp
    [[nodiscard]] vec2 onWindow(const vec2& pixel) const;
    [[nodiscard]] vec2 onWindowOf(const vec4& clip) const;
    void drawHemisphere() const;
    void drawShadowSearch() const;
    void drawCells() const;
    void drawMirrorRay(const RecordedRay& ray) const;

    Workspace& work_;
    RenderThread& render_;
    std::optional<Picked> picked_;
    Explains explains_ = Explains::mirror;  ///< which rays of the picked pixel are drawn
    bool opensPanel_ = false;
};

}  // namespace reflet
