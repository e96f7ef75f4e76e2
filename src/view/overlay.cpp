// Draws over the image.
#include "view/overlay.h"

#include "compare/heat_map.h"
#include "view/switches.h"

#include <imgui.h>

#include <array>
#include <optional>
#include <utility>

namespace reflet {

namespace {

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

}  // namespace

void Overlay::drawDivider() const {
    const PictureRect rect = work_.pictureRect();
    const float x = rect.min.x + work_.state.compare.divider * rect.size.x;
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
    label(fmt::format("A: {}{}", work_.state.preset,
                      sameSettings(work_.state.settings, work_.state.ofPreset) ? "" : ", changed"),
          true);
    label(fmt::format("B: {}", compare_.name(work_.state)), false);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (!ImGui::GetIO().WantCaptureMouse && mouse.x >= rect.min.x) {
        drawErrorAt({mouse.x, mouse.y});
    }
}

// Both sides' values and their error at the pointer.
void Overlay::drawErrorAt(const vec2& mouse) const {
    const PictureRect rect = work_.pictureRect();
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
    for (const auto& [name, image] :
         {std::pair(std::string("A"), work_.live().values), std::pair(std::string("B"), compare_.values()),
          std::pair(compare_.errorName(), compare_.errorMap())}) {
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

// The colours of the image 'source'.
void Overlay::drawSourceLegend() const {
    struct Line {
        ImU32 color;
        const char* text;
    };
    static constexpr std::array<Line, 5> sources{{{IM_COL32(0, 255, 255, 255), "planar reflection"},
                                                  {IM_COL32(0, 255, 0, 255), "screen"},
                                                  {IM_COL32(255, 255, 0, 255), "ray tracing"},
                                                  {IM_COL32(255, 0, 255, 255), "probes"},
                                                  {IM_COL32(0, 0, 255, 255), "environment"}}};
    const PictureRect rect = work_.pictureRect();
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float side = ImGui::GetFontSize();
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

void Overlay::drawErrorLegend() const {
    const PictureRect rect = work_.pictureRect();
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float side = ImGui::GetFontSize();
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
        draw.AddRectFilled({corner.x + float(i) * width, corner.y}, {corner.x + float(i + 1) * width, corner.y + side},
                           IM_COL32(c[0], c[1], c[2], 255));
    }
    const float below = corner.y + 1.3F * side;
    draw.AddText({corner.x, below}, IM_COL32_WHITE, "0");
    draw.AddText({corner.x + 4.0F * side, below}, IM_COL32_WHITE, "HDR-FLIP");
    draw.AddText({corner.x + 11.4F * side, below}, IM_COL32_WHITE, "1");
}

// What is switched off, where no panel says it.
void Overlay::drawSwitchedOff() const {
    const std::string off = switchedOff(work_.state.settings, work_.state.ofPreset);
    if (!off.empty() && !work_.state.panels) {
        const vec2 at = work_.pictureRect().min + vec2(10.0F, 8.0F);
        ImGui::GetBackgroundDrawList()->AddText({at.x, at.y}, IM_COL32(255, 200, 90, 255), ("off: " + off).c_str());
    }
}

void Overlay::drawKeys() {
    const uvec2 window = window_.size();
    ImGui::SetNextWindowPos({0.5F * float(window.x), 0.5F * float(window.y)}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::Begin("Keys", &work_.state.help,
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

void Overlay::draw() {
    const Compare& compare = work_.state.compare;
    const bool compares = compare.with != CompareWith::nothing;
    if (compares) {
        drawDivider();
    }
    pixel_.drawOverlay();
    if (work_.state.show.ends_with("source")) {
        drawSourceLegend();
    }
    if (compares && compare.errorImage && compare_.errorMap()) {
        drawErrorLegend();
    }
    drawSwitchedOff();
    if (work_.state.help) {
        drawKeys();
    }
}

}  // namespace reflet
