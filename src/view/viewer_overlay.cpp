// Draws over the image: the divider, the picked pixel's ray, help.
#include "view/viewer.h"

#include "base/error.h"
#include "compare/heat_map.h"
#include "view/switches.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

namespace reflet {

namespace {

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

// The diffuse rays, coloured by who answers them: as in the image 'source'.
void Viewer::drawHemisphere() {
    const Settings& s = state_.settings;
    constexpr ImU32 screen = IM_COL32(0, 255, 0, 170);
    const ImU32 next = s.traceScene.enabled != 0    ? IM_COL32(255, 255, 0, 150)
                       : s.probes.enabled != 0      ? IM_COL32(255, 0, 255, 150)
                       : s.environment.enabled != 0 ? IM_COL32(80, 80, 255, 170)
                                                    : IM_COL32(120, 120, 120, 150);
    const mat4& toClip = now_.live->view.worldToClip;
    const auto onPicture = [&](const vec4& clip) {
        const vec2 at = onWindow((0.5F + 0.5F * vec2(clip) / clip.w) * vec2(now_.live->size));
        return ImVec2(at.x, at.y);
    };
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const vec3 start = picked_->ray->start;
    const float reach = 0.12F * glm::distance(start, state_.view.camera.position);  // of rays that end nowhere
    for (const RecordedSample& sample : picked_->hemisphere) {
        const vec3 end = start + (sample.hits ? sample.distance : reach) * sample.direction;
        if (const auto line = inFront(toClip * vec4(start, 1.0F), toClip * vec4(end, 1.0F))) {
            const ImU32 color = sample.hits && s.traceScreen.enabled != 0 ? screen : next;
            draw.AddLine(onPicture(line->first), onPicture(line->second), color, 1.0F);
            if (color == screen) {
                draw.AddCircleFilled(onPicture(line->second), 2.5F, color, 6);
            }
        }
    }
}

// The look-ups of the sun's shadow: red where something blocks, drawn where it is; else green, beside the point.
void Viewer::drawShadowSearch() {
    const RecordedShadow& shadow = *picked_->shadow;
    const mat4& toClip = now_.live->view.worldToClip;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const auto onPicture = [&](const vec3& place) -> std::optional<ImVec2> {
        const vec4 clip = toClip * vec4(place, 1.0F);
        if (clip.w < 1e-3F) {
            return std::nullopt;
        }
        const vec2 at = onWindow((0.5F + 0.5F * vec2(clip) / clip.w) * vec2(now_.live->size));
        return ImVec2(at.x, at.y);
    };
    const std::optional<ImVec2> point = onPicture(shadow.point);
    for (const RecordedShadow::Texel& texel : shadow.texels) {
        const std::optional<ImVec2> at = onPicture(texel.place);
        if (!at || !point) {
            continue;
        }
        if (texel.blocks) {
            draw.AddLine(*point, *at, IM_COL32(255, 90, 80, 90), 1.0F);
        }
        draw.AddCircleFilled(*at, 2.5F, texel.blocks ? IM_COL32(255, 90, 80, 255) : IM_COL32(90, 230, 110, 255), 6);
    }
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
    const auto label = [&](const std::string& text, bool left) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const ImVec2 at(left ? x - size.x - 10.0F : x + 10.0F, rect.min.y + 6.0F);
        draw.AddRectFilled({at.x - 4.0F, at.y - 2.0F}, {at.x + size.x + 4.0F, at.y + size.y + 2.0F},
                           IM_COL32(0, 0, 0, 150), 3.0F);
        draw.AddText(at, IM_COL32_WHITE, text.c_str());
    };
    label(fmt::format("A: {}{}", state_.preset, sameSettings(state_.settings, state_.ofPreset) ? "" : ", changed"),
          true);
    label(fmt::format("B: {}", compare_.name(state_)), false);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (!ImGui::GetIO().WantCaptureMouse && mouse.x >= rect.min.x) {
        drawErrorAt({mouse.x, mouse.y});
    }
}

// Both sides' values and their error at the pointer.
void Viewer::drawErrorAt(const vec2& mouse) {
    const PictureRect rect = pictureRect();
    const vec2 at = (mouse - rect.min) / rect.size;
    const auto valueAt = [&](const std::shared_ptr<const FloatImage>& image) -> std::optional<std::string> {
        if (!image || at.x < 0.0F || at.y < 0.0F || at.x >= 1.0F || at.y >= 1.0F) {
            return std::nullopt;
        }
        const uvec2 pixel(at * vec2(image->width, image->height));
        const size_t channels = image->channels.size();
        const auto first =
            image->data.begin() + static_cast<std::ptrdiff_t>((size_t(pixel.y) * image->width + pixel.x) * channels);
        return valuesText(std::vector<float>(first, first + static_cast<std::ptrdiff_t>(channels)));
    };
    std::string lines;
    for (const auto& [name, image] : {std::pair("A", now_.live->values), std::pair("B", compare_.values()),
                                      std::pair("HDR-FLIP", compare_.errorMap())}) {
        if (const auto value = valueAt(image)) {
            lines += fmt::format("{}{}  {}", lines.empty() ? "" : "\n", name, *value);
        }
    }
    if (!lines.empty()) {
        ImGui::SetNextWindowPos({mouse.x + 16.0F, mouse.y + 16.0F});
        ImGui::BeginTooltip();
        ImGui::TextUnformatted(lines.c_str());
        ImGui::EndTooltip();
    }
}

// What the colours mean: sources of light, errors; and what is switched off, if no panel says it.
void Viewer::drawLegends() {
    struct Line {
        ImU32 color;
        const char* text;
    };
    static constexpr std::array<Line, 5> sources{{{IM_COL32(0, 255, 255, 255), "planar reflection"},
                                                  {IM_COL32(0, 255, 0, 255), "screen"},
                                                  {IM_COL32(255, 255, 0, 255), "ray tracing"},
                                                  {IM_COL32(255, 0, 255, 255), "probes"},
                                                  {IM_COL32(0, 0, 255, 255), "environment"}}};
    const PictureRect rect = pictureRect();
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float side = ImGui::GetFontSize();
    if (state_.show.ends_with("source")) {
        const ImVec2 corner(rect.min.x + 10.0F, rect.min.y + rect.size.y - line * float(sources.size()) - 14.0F);
        draw.AddRectFilled({corner.x - 6.0F, corner.y - 6.0F},
                           {corner.x + 12.0F * side, corner.y + line * float(sources.size()) + 4.0F},
                           IM_COL32(0, 0, 0, 170), 3.0F);
        for (size_t i = 0; i < sources.size(); ++i) {
            const float y = corner.y + float(i) * line;
            draw.AddRectFilled({corner.x, y}, {corner.x + side, y + side}, sources[i].color);
            draw.AddText({corner.x + 1.6F * side, y}, IM_COL32_WHITE, sources[i].text);
        }
    }
    if (state_.compare.with != CompareWith::nothing && state_.compare.errorImage && compare_.errorMap()) {
        constexpr uint32_t steps = 64;
        static const Bitmap colors = [] {
            FloatImage ramp{steps, 1, {"Y"}, {}};
            for (uint32_t i = 0; i < steps; ++i) {
                ramp.data.push_back((float(i) + 0.5F) / float(steps));
            }
            return heatMap(ramp);
        }();
        const float width = 12.0F * side / float(steps);
        const ImVec2 corner(rect.min.x + rect.size.x - 12.0F * side - 20.0F, rect.min.y + rect.size.y - 3.2F * side);
        draw.AddRectFilled({corner.x - 8.0F, corner.y - 6.0F}, {corner.x + 12.0F * side + 8.0F, corner.y + 2.8F * side},
                           IM_COL32(0, 0, 0, 170), 3.0F);
        for (uint32_t i = 0; i < steps; ++i) {
            const uint8_t* c = colors.data.data() + size_t(i) * colors.channels;
            draw.AddRectFilled({corner.x + float(i) * width, corner.y},
                               {corner.x + float(i + 1) * width, corner.y + side}, IM_COL32(c[0], c[1], c[2], 255));
        }
        const float below = corner.y + 1.3F * side;
        draw.AddText({corner.x, below}, IM_COL32_WHITE, "0");
        draw.AddText({corner.x + 4.0F * side, below}, IM_COL32_WHITE, "HDR-FLIP");
        draw.AddText({corner.x + 11.4F * side, below}, IM_COL32_WHITE, "1");
    }
    if (const std::string off = switchedOff(state_.settings, state_.ofPreset); !off.empty() && !state_.panels) {
        draw.AddText({rect.min.x + 10.0F, rect.min.y + 8.0F}, IM_COL32(255, 200, 90, 255), ("off: " + off).c_str());
    }
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
    if (picked_->shadow && explains_ == Explains::shadow) {
        drawShadowSearch();
    } else if (picked_->ray && explains_ == Explains::diffuse) {
        drawHemisphere();
    } else if (picked_->ray) {
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
            const bool hit = countsAsHit(ray, state_.settings.traceScreen);
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

void Viewer::helpOverlay() {
    constexpr std::array<std::array<const char*, 2>, 22> keys{
        {{"1 2 3 4 5", "direct light, SSGI, SSR, AO, shadows on and off"},
         {"left drag", "orbit"},
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
