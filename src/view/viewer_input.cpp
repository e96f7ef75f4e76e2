// Handles keys and the pointer.
#include "base/error.h"
#include "scene/camera_control.h"
#include "scene/framing.h"
#include "scene/pose.h"
#include "view/switches.h"
#include "view/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet {

namespace {

constexpr float orbitSpeed = 0.006F;  // radians per desktop unit
constexpr float turnSpeed = 0.003F;
constexpr float wheelFactor = 0.88F;
constexpr float clickSlack = 4.0F;  // units that the pointer may move during a click
constexpr float dividerSlack = 6.0F;

vec2 toVec(const ImVec2& v) {
    return {v.x, v.y};
}

}  // namespace

void Viewer::handleKeys() {
    for (const KeyPress& press : window_.takeKeys()) {
        handleKey(press);
    }
}

void Viewer::handleControlKey(const KeyPress& press) {
    switch (press.key) {
        case GLFW_KEY_C:
            attempt([&] {
                const std::string line = commandLine();
                window_.copyText(line);
                tell(fmt::format("Copied: {}", line));
            });
            break;
        case GLFW_KEY_S:
            attempt([&] { takeScreenshot(""); });
            break;
        case GLFW_KEY_Q:
            window_.close();
            break;
        default:
            break;
    }
}

void Viewer::handleKey(const KeyPress& press) {
    if (press.control) {
        handleControlKey(press);
        return;
    }
    for (const Switch& part : switches()) {
        if (press.key == part.key) {
            part.set(state_.settings, !part.isOn(state_.settings), state_.ofPreset);
        }
    }
    switch (press.key) {
        case GLFW_KEY_F1:
        case GLFW_KEY_H:
            state_.help = !state_.help;
            break;
        case GLFW_KEY_ESCAPE:
            if (state_.help) {
                state_.help = false;
            } else {
                picked_.reset();
            }
            break;
        case GLFW_KEY_TAB:
            state_.panels = !state_.panels;
            break;
        case GLFW_KEY_SPACE:
            state_.running = state_.running == Running::paused ? Running::onDemand : Running::paused;
            break;
        case GLFW_KEY_PERIOD:
            ++steps_;
            break;
        case GLFW_KEY_C:
            state_.running = state_.running == Running::continuous ? Running::onDemand : Running::continuous;
            break;
        case GLFW_KEY_F:
            frameScene(detachedCamera(), scene(), float(renderSize().x) / float(renderSize().y), state_.view.time);
            break;
        case GLFW_KEY_R:
            state_.view.camera = opened_.firstView.camera;
            break;
        case GLFW_KEY_P:
            state_.plays = !state_.plays;
            break;
        case GLFW_KEY_X:
            state_.compare.divider = state_.compare.divider < 0.5F ? 1.0F : 0.0F;
            break;
        default:
            break;
    }
}

// The camera for moving it by hand: detached from its node, if any, at the node's current pose.
Camera& Viewer::detachedCamera() {
    state_.view.camera = posed(state_.view, scene()).camera;
    return state_.view.camera;
}

uvec2 Viewer::pixelAt(const vec2& mouse) const {
    const PictureRect rect = pictureRect();
    const uvec2 size = renderSize();
    const vec2 at = (mouse - rect.min) / rect.size * vec2(size);
    return glm::min(uvec2(glm::max(at, vec2(0.0F))), size - 1U);
}

void Viewer::handlePointer() {
    const ImGuiIO& io = ImGui::GetIO();
    const PictureRect rect = pictureRect();
    const vec2 mouse = toVec(io.MousePos);
    const auto isInside = [&](const vec2& at) {
        return !io.WantCaptureMouse && glm::all(glm::greaterThanEqual(at, rect.min)) &&
               glm::all(glm::lessThan(at, rect.min + rect.size));
    };
    const bool inside = isInside(mouse);
    const bool pressed = ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
    const float divider = rect.min.x + state_.compare.divider * rect.size.x;
    if (pressed) {  // during a slow frame the pointer may have moved on and the button been released
        pressedAt_ = window_.pressedAt();
        pointerBefore_ = pressedAt_;
        pressedInPicture_ = isInside(pressedAt_);
        dragsDivider_ = pressedInPicture_ && ImGui::IsMouseClicked(0) && state_.compare.with != CompareWith::nothing &&
                        std::abs(pressedAt_.x - divider) < dividerSlack;
    }
    if (inside && io.MouseWheel != 0.0F) {
        dolly(detachedCamera(), std::pow(wheelFactor, io.MouseWheel));
    }
    if (!pressedInPicture_) {
        return;
    }
    const vec2 moved = mouse - std::exchange(pointerBefore_, mouse);
    if (dragsDivider_) {
        if (ImGui::IsMouseDown(0)) {
            state_.compare.divider = std::clamp((mouse.x - rect.min.x) / rect.size.x, 0.0F, 1.0F);
        }
    } else if (moved != vec2(0.0F) && glm::distance(mouse, pressedAt_) >= clickSlack) {
        Camera& camera = detachedCamera();
        if (ImGui::IsMouseDown(2) || (ImGui::IsMouseDown(0) && io.KeyShift)) {
            pan(camera, moved / rect.size.y);
        } else if (ImGui::IsMouseDown(0)) {
            orbit(camera, orbitSpeed * moved);
        } else if (ImGui::IsMouseDown(1)) {
            turn(camera, turnSpeed * moved);
        }
    }
    if (ImGui::IsMouseReleased(0) && !dragsDivider_ && glm::distance(mouse, pressedAt_) < clickSlack && inside) {
        opensPixel_ = true;
        pickPixel(pixelAt(mouse), io.KeyAlt);
    }
    if (!ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2)) {
        pressedInPicture_ = false;
        dragsDivider_ = false;
    }
}

void Viewer::flyByKeys() {
    const auto held = [&](int more, int less) {
        return float(window_.isHeld(more) ? 1 : 0) - float(window_.isHeld(less) ? 1 : 0);
    };
    if (window_.isHeld(GLFW_KEY_LEFT_CONTROL) || window_.isHeld(GLFW_KEY_RIGHT_CONTROL)) {
        return;
    }
    const vec3 way(held(GLFW_KEY_D, GLFW_KEY_A), held(GLFW_KEY_E, GLFW_KEY_Q), held(GLFW_KEY_W, GLFW_KEY_S));
    if (way == vec3(0.0F)) {
        return;
    }
    constexpr double longestStep = 0.1;  // seconds, so that the first step after an idle period is not a jump
    const float fast = window_.isHeld(GLFW_KEY_LEFT_SHIFT) ? 4.0F : 1.0F;
    const float metres = fast * flightSpeed(scene().bounds()) * float(std::min(elapsed_, longestStep));
    fly(detachedCamera(), metres * way);
    redraws_ = std::max(redraws_, 2);
}

}  // namespace reflet
