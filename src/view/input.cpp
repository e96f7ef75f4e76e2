// Handles keys and the pointer.
#include "view/input.h"

#include "scene/camera_control.h"
#include "view/switches.h"

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

void Input::handleKeys() {
    for (const KeyPress& press : window_.takeKeys()) {
        press.control ? handleControlKey(press.key) : handleKey(press.key);
    }
}

void Input::handleControlKey(int key) {
    switch (key) {
        case GLFW_KEY_C:
            actions_.copyCommandLine();
            break;
        case GLFW_KEY_S:
            work_.attempt([&] { actions_.takeScreenshot(""); });
            break;
        case GLFW_KEY_Q:
            actions_.quit();
            break;
        default:
            break;
    }
}

void Input::handleKey(int key) {
    for (const Switch& part : switches()) {
        if (key == part.key) {
            part.set(work_.state.settings, !part.isOn(work_.state.settings), work_.state.ofPreset);
        }
    }
    switch (key) {
        case GLFW_KEY_F1:
        case GLFW_KEY_H:
            work_.state.help = !work_.state.help;
            break;
        case GLFW_KEY_ESCAPE:
            if (work_.state.help) {
                work_.state.help = false;
            } else {
                pixel_.forget();
            }
            break;
        case GLFW_KEY_TAB:
            work_.state.panels = !work_.state.panels;
            break;
        case GLFW_KEY_SPACE:
            work_.state.running = work_.state.running == Running::paused ? Running::onDemand : Running::paused;
            break;
        case GLFW_KEY_PERIOD:
            ++work_.steps;
            break;
        case GLFW_KEY_C:
            work_.state.running = work_.state.running == Running::continuous ? Running::onDemand : Running::continuous;
            break;
        case GLFW_KEY_F:
            actions_.frameAll();
            break;
        case GLFW_KEY_R:
            actions_.resetCamera();
            break;
        case GLFW_KEY_P:
            work_.state.plays = !work_.state.plays;
            break;
        case GLFW_KEY_X:
            work_.state.compare.divider = work_.state.compare.divider < 0.5F ? 1.0F : 0.0F;
            break;
        default:
            break;
    }
}

uvec2 Input::pixelAt(const vec2& mouse) const {
    const PictureRect rect = work_.pictureRect();
    const uvec2 size = work_.renderSize();
    const vec2 at = (mouse - rect.min) / rect.size * vec2(size);
    return glm::min(uvec2(glm::max(at, vec2(0.0F))), size - 1U);
}

bool Input::isInPicture(const vec2& at) const {
    const PictureRect rect = work_.pictureRect();
    return !ImGui::GetIO().WantCaptureMouse && glm::all(glm::greaterThanEqual(at, rect.min)) &&
           glm::all(glm::lessThan(at, rect.min + rect.size));
}

// During a slow frame the pointer may have moved on and the button been released.
void Input::startDrag() {
    const PictureRect rect = work_.pictureRect();
    const float divider = rect.min.x + work_.state.compare.divider * rect.size.x;
    pressedAt_ = window_.pressedAt();
    pointerBefore_ = pressedAt_;
    pressedInPicture_ = isInPicture(pressedAt_);
    dragsDivider_ = pressedInPicture_ && ImGui::IsMouseClicked(0) && work_.state.compare.with != CompareWith::nothing &&
                    std::abs(pressedAt_.x - divider) < dividerSlack;
}

void Input::dragCamera(const vec2& moved) {
    Camera& camera = work_.detachedCamera();
    if (ImGui::IsMouseDown(2) || (ImGui::IsMouseDown(0) && ImGui::GetIO().KeyShift)) {
        pan(camera, moved / work_.pictureRect().size.y);
    } else if (ImGui::IsMouseDown(0)) {
        orbit(camera, orbitSpeed * moved);
    } else if (ImGui::IsMouseDown(1)) {
        turn(camera, turnSpeed * moved);
    }
}

void Input::handlePointer() {
    const ImGuiIO& io = ImGui::GetIO();
    const vec2 mouse = toVec(io.MousePos);
    const bool inside = isInPicture(mouse);
    if (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2)) {
        startDrag();
    }
    if (inside && io.MouseWheel != 0.0F) {
        dolly(work_.detachedCamera(), std::pow(wheelFactor, io.MouseWheel));
    }
    if (!pressedInPicture_) {
        return;
    }
    const vec2 moved = mouse - std::exchange(pointerBefore_, mouse);
    const bool isClick = glm::distance(mouse, pressedAt_) < clickSlack;
    if (dragsDivider_) {
        if (ImGui::IsMouseDown(0)) {
            const PictureRect rect = work_.pictureRect();
            work_.state.compare.divider = std::clamp((mouse.x - rect.min.x) / rect.size.x, 0.0F, 1.0F);
        }
    } else if (moved != vec2(0.0F) && !isClick) {
        dragCamera(moved);
    }
    if (ImGui::IsMouseReleased(0) && !dragsDivider_ && isClick && inside) {
        pixel_.openPanel();
        pixel_.pick(pixelAt(mouse), io.KeyAlt);
    }
    if (!ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2)) {
        pressedInPicture_ = false;
        dragsDivider_ = false;
    }
}

void Input::fly(double elapsed) {
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
    const float metres = fast * flightSpeed(work_.scene().bounds()) * float(std::min(elapsed, longestStep));
    reflet::fly(work_.detachedCamera(), metres * way);
    work_.redraw(2);
}

}  // namespace reflet
