// The state that the parts of the window share.
#include "view/workspace.h"

#include "scene/pose.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

namespace reflet {

namespace {

constexpr int settlingRedraws = 3;

}  // namespace

Workspace::Workspace(ViewerState first, const Window& window, uint32_t largestSide)
    : state(std::move(first)), window_(window), largestSide_(largestSide), redraws_(settlingRedraws) {
    published.live = std::make_shared<const RenderedImage>();
}

PictureRect Workspace::pictureRect() const {
    const vec2 window(window_.size());
    const float left = state.panels ? std::min(state.panelWidth * window_.scale(), 0.8F * window.x) : 0.0F;
    return {{left, 0.0F}, glm::max(window - vec2(left, 0.0F), vec2(1.0F))};
}

uvec2 Workspace::renderSize() const {
    const vec2 perUnit = vec2(window_.pixels()) / glm::max(vec2(window_.size()), vec2(1.0F));
    const vec2 size = pictureRect().size * perUnit * state.scale;
    return glm::clamp(uvec2(glm::round(size)), uvec2(16), uvec2(largestSide_));
}

Camera& Workspace::detachedCamera() {
    state.view.camera = posed(state.view, scene()).camera;
    return state.view.camera;
}

void Workspace::focusAt(float distance) {
    state.view.camera.focus.clear();
    state.view.camera.focusDistance = distance;
}

void Workspace::attempt(const std::function<void()>& work) {
    try {
        work();
        problem_.clear();
    } catch (const std::runtime_error& error) {  // std::filesystem throws others than Error
        problem_ = error.what();
    } catch (const std::bad_alloc&) {
        problem_ = "not enough memory";
    }
    redrawUntilSettled();
}

void Workspace::redraw(int times) {
    redraws_ = std::max(redraws_, times);
}

void Workspace::redrawUntilSettled() {
    redraws_ = settlingRedraws;
}

void Workspace::noteRedraw() {
    redraws_ = std::max(redraws_ - 1, 0);
}

}  // namespace reflet
