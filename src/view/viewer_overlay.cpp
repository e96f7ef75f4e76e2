// Draws over the image: the divider, the picked pixel's ray, help.
#include "view/viewer.h"

#include "base/error.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

namespace reflet {

namespace {

std::string text(const std::vector<float>& values) {
    std::string all;
    for (const float value : values) {
        all += fmt::format("{}{:.4g}", all.empty() ? "" : "  ", value);
    }
    return all;
}

// Whether these settings count the hit: back faces may be rejected.
bool isHit(const RecordedRay& ray, const TraceScreenSettings& settings) {
    return ray.outcome == RayOutcome::hit && !(ray.facesAway && settings.rejectBackfaces != 0);
}

// Explains the outcome of the mirror ray.
std::string explanation(const RecordedRay& ray, const TraceScreenSettings& settings) {
    const std::string at = fmt::format("pixel {}, {}", ray.pixel.x, ray.pixel.y);
    std::string why;
    if (isHit(ray, settings)) {
        why = fmt::format(
            "Hit: after {:.3g} m it meets the surface at {}. Confidence {:.2f}: edge {:.2f}, distance {:.2f}, "
            "camera {:.2f}.",
            ray.distance, at, ray.confidence, ray.edge, ray.far, ray.camera);
    } else if (ray.outcome == RayOutcome::hit) {
        why = fmt::format(
            "Miss: after {:.3g} m it meets the surface at {} from behind, but only its front is on the screen "
            "(trace_screen.reject_backfaces).",
            ray.distance, at);
    } else if (ray.outcome == RayOutcome::leftScreen) {
        why = fmt::format(
            "Miss: it leaves the screen after {:.3g} m. The fallbacks are trace_scene, probes and the "
            "environment.",
            ray.distance);
    } else if (ray.outcome == RayOutcome::hidden) {
        why = fmt::format("Miss: it passes behind a surface by more than trace_screen.thickness ({:g} m).",
                          settings.thickness);
    } else {
        why = fmt::format("Miss: it has reached trace_screen.max_steps ({}) or trace_screen.max_distance ({:g} m).",
                          settings.maxSteps, settings.maxDistance);
    }
    if (ray.lost && !isHit(ray, settings)) {
        why += fmt::format(
            " From {:.3g} m on it was occluded: behind a visible surface by more than trace_screen.thickness "
            "({:g} m).",
            ray.clear, settings.thickness);
    }
    return why;
}

// Clips a line in clip space to the part in front of the camera.
std::optional<std::pair<vec4, vec4>> inFront(vec4 a, vec4 b) {
    constexpr float nearest = 1e-3F;  // metres in front of a perspective camera; orthographic: w is 1
    if (a.w < nearest && b.w < nearest) {
        return std::nullopt;
    }
    const vec4 middle = glm::mix(a, b, (nearest - a.w) / (b.w - a.w));
    return std::pair(a.w < nearest ? middle : a, b.w < nearest ? middle : b);
}

}  // namespace

vec2 Viewer::onWindow(const vec2& pixel) const {
    const PictureRect rect = pictureRect();
    return rect.min + pixel / vec2(now_.live->size) * rect.size;
}

void Viewer::drawDivider() {
    if (state_.compare.with == CompareWith::nothing) {
        return;
    }
    const PictureRect rect = pictureRect();
    const float x = rect.min.x + state_.compare.divider * rect.size.x;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddLine({x, rect.min.y}, {x, rect.min.y + rect.size.y}, IM_COL32(255, 255, 255, 200), 1.5F);
    const float y = rect.min.y + 0.5F * rect.size.y;
    draw.AddCircleFilled({x, y}, 7.0F, IM_COL32(255, 255, 255, 220));
    draw.AddText({x - ImGui::CalcTextSize("A").x - 8.0F, rect.min.y + 6.0F}, IM_COL32_WHITE, "A");
    draw.AddText({x + 8.0F, rect.min.y + 6.0F}, IM_COL32_WHITE, "B");
}

// The steps and the pixel are valid only for the view at the time of the pick. The ray is in world space and is also
// drawn from other views.
void Viewer::drawRay() {
    if (!picked_ || now_.live->frames == 0) {
        return;
    }
    const PictureRect rect = pictureRect();
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.PushClipRect({rect.min.x, rect.min.y}, {rect.min.x + rect.size.x, rect.min.y + rect.size.y});
    const vec2 perPixel = rect.size / vec2(now_.live->size);
    const auto at = [](const vec2& v) { return ImVec2(v.x, v.y); };
    const bool asPicked = isPickedView();
    if (picked_->ray) {
        const RecordedRay& ray = *picked_->ray;
        for (const RayStep& step : asPicked ? std::span(ray.steps) : std::span<const RayStep>()) {
            const auto side = static_cast<float>(1U << step.level);
            const vec2 low = onWindow(vec2(step.cell) * side);
            if (step.level > 0 || perPixel.x >= 4.0F) {
                draw.AddRect(at(low), at(low + side * perPixel), IM_COL32(120, 200, 255, 110));
            } else {
                draw.AddCircleFilled(at(low + 0.5F * perPixel), 1.8F, IM_COL32(120, 200, 255, 220), 6);
            }
        }
        const mat4& toClip = now_.live->view.worldToClip;
        if (const auto line = inFront(toClip * vec4(ray.start, 1.0F),
                                      toClip * vec4(ray.start + ray.distance * ray.direction, 1.0F))) {
            const auto onPicture = [&](const vec4& clip) {
                return onWindow((0.5F + 0.5F * vec2(clip) / clip.w) * vec2(now_.live->size));
            };
            const vec2 start = onPicture(line->first);
            const vec2 end = onPicture(line->second);
            const bool hit = isHit(ray, state_.settings.traceScreen);
            const ImU32 color = hit ? IM_COL32(90, 230, 110, 255) : IM_COL32(255, 90, 80, 255);
            draw.AddLine(at(start), at(end), color, 1.5F);
            draw.AddCircleFilled(at(start), 2.5F, color, 8);
            if (hit) {
                draw.AddCircle(at(end), 6.0F, color, 16, 2.0F);
            } else {
                draw.AddLine(at(end - 5.0F), at(end + 5.0F), color, 2.0F);
                draw.AddLine(at(end + vec2(-5.0F, 5.0F)), at(end + vec2(5.0F, -5.0F)), color, 2.0F);
            }
        }
    }
    if (asPicked) {
        draw.AddCircle(at(onWindow(vec2(picked_->pixel) + 0.5F)), 5.0F, IM_COL32(255, 255, 255, 255), 16, 1.5F);
    }
    draw.PopClipRect();
}

void Viewer::pixelPanel() {
    if (!picked_) {
        ImGui::TextDisabled("Click on the image to pick a pixel.");
        return;
    }
    ImGui::Text("pixel %u, %u", picked_->pixel.x, picked_->pixel.y);
    ImGui::SameLine();
    if (ImGui::Button("again")) {
        pickPixel(glm::min(picked_->pixel, renderSize() - 1U), false);
    }
    places_.note("pick again");
    tooltip(
        "Picks this pixel again in the current image. Changes of settings and light do so automatically; a moved "
        "camera shows the recorded ray from its new position.");
    ImGui::SameLine();
    if (ImGui::Button("focus here")) {
        attempt([&] { focusOnPicked(); });
    }
    places_.note("focus here");
    tooltip("Puts the plane of focus of the camera's lens at this pixel's depth.");
    if (picked_->ray) {
        ImGui::PushTextWrapPos(0.0F);
        ImGui::Text("Mirror ray, %u depth samples", picked_->ray->samples);
        ImGui::TextUnformatted(explanation(*picked_->ray, state_.settings.traceScreen).c_str());
        ImGui::PopTextWrapPos();
    } else {
        ImGui::TextUnformatted("No surface here.");
    }
    if (ImGui::BeginTable("values", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        for (const PickedValues& values : picked_->values) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(values.name.c_str());
            tooltip(std::string(findShow(values.name).description));
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(text(values.values).c_str());
        }
        ImGui::EndTable();
    }
}

void Viewer::helpOverlay() {
    constexpr std::array<std::array<const char*, 2>, 21> keys{{{"left drag", "orbit"},
                                                               {"middle drag, Shift+left drag", "pan"},
                                                               {"wheel", "move closer, farther"},
                                                               {"right drag", "look around"},
                                                               {"W A S D, Q E", "fly; Shift: faster"},
                                                               {"click", "pick the pixel: values and mirror ray"},
                                                               {"Alt+click", "focus the lens there"},
                                                               {"F", "frame all"},
                                                               {"R", "reset the camera"},
                                                               {"space", "pause"},
                                                               {".", "render one frame"},
                                                               {"C", "continuous rendering"},
                                                               {"P", "play animations"},
                                                               {"X", "only A, only B"},
                                                               {"Tab", "panels"},
                                                               {"Ctrl+S", "screenshot"},
                                                               {"Ctrl+C", "copy the command line"},
                                                               {"Esc", "clear the picked pixel"},
                                                               {"Ctrl+click on a slider", "type a value"},
                                                               {"F1, H", "this list"},
                                                               {"Ctrl+Q", "quit; the state is saved"}}};
    const uvec2 window = window_.size();
    ImGui::SetNextWindowPos({0.5F * float(window.x), 0.5F * float(window.y)}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::Begin("Keys", &state_.help,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    if (ImGui::BeginTable("keys", 2)) {
        for (const auto& [key, meaning] : keys) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(key);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(meaning);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace reflet
