// The panels on the left.
#include "view/panels.h"

#include "renderer/presets.h"
#include "view/panel_text.h"
#include "view/progress_text.h"
#include "view/switches.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

namespace reflet {

namespace {

std::string megabytes(uint64_t bytes) {
    return fmt::format("{:.0f} MiB", double(bytes) / double(1 << 20));
}

}  // namespace

Panels::Panels(Workspace& work, const Parts& parts)
    : work_(work),
      window_(parts.window),
      render_(parts.render),
      actions_(parts.actions),
      pixel_(parts.pixel),
      times_(parts.times),
      light_(work),
      camera_(work, parts.actions),
      compare_(work, parts.compare),
      files_(work, parts.actions, parts.opener) {}

void Panels::runPanel() {
    int running = static_cast<int>(work_.state.running);
    ImGui::RadioButton("on demand", &running, int(Running::onDemand));
    work_.places.note("on demand");
    tooltip("Renders after a change until more frames change nothing.");
    ImGui::SameLine();
    ImGui::RadioButton("continuous", &running, int(Running::continuous));
    work_.places.note("continuous");
    tooltip("Renders all the time (C).");
    ImGui::SameLine();
    ImGui::RadioButton("pause", &running, int(Running::paused));
    work_.places.note("pause");
    tooltip("Renders nothing (space). Panels still work.");
    work_.state.running = static_cast<Running>(running);
    ImGui::SameLine();
    if (ImGui::Button("step")) {
        ++work_.steps;
    }
    work_.places.note("step");
    tooltip("Renders one frame (.).");
    const uvec2 size = work_.renderSize();
    const std::string progress = progressText(work_.published, work_.state.running, render_.busyWith());
    ImGui::TextColored(quietColor, "%ux%u, %s", size.x, size.y, progress.c_str());
    if (const std::optional<float> stops = work_.live().exposure) {
        ImGui::TextColored(quietColor, "automatic exposure: %+.2f stops", double(*stops));
    }
    timePanel();
}

// Of animations.
void Panels::timePanel() {
    if (work_.scene().animations.empty()) {
        return;
    }
    ImGui::Checkbox("play animations", &work_.state.plays);
    work_.places.note("play");
    auto time = static_cast<float>(work_.state.view.time);
    if (ImGui::DragFloat("time [s]", &time, 0.02F, 0.0F, 1e6F, "%.2f", ImGuiSliderFlags_AlwaysClamp)) {
        work_.state.view.time = double(time);
    }
}

void Panels::switchesPanel() {
    for (const Switch& part : switches()) {
        bool on = part.isOn(work_.state.settings);
        if (ImGui::Checkbox(part.name, &on)) {
            part.set(work_.state.settings, on, work_.state.ofPreset);
        }
        work_.places.note(fmt::format("switch {}", part.name));
        tooltip(fmt::format("{} Key {}.", part.help, static_cast<char>(part.key)));
        if (&part != &switches().back()) {
            ImGui::SameLine();
        }
    }
    if (const std::string off = switchedOff(work_.state.settings, work_.state.ofPreset); !off.empty()) {
        ImGui::TextColored(changedColor, "off: %s", off.c_str());
    }
}

void Panels::settingsPanel() {
    std::string preset = work_.state.preset;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.5F);
    if (chooseName("preset", presetNames(), preset)) {
        actions_.applyPresetNamed(preset);
    }
    work_.places.note("preset");
    const std::vector<Preset> all = presets();
    const auto described = std::ranges::find(all, work_.state.preset, &Preset::name);
    tooltip(described == all.end() ? "" : described->description);
    ImGui::SameLine();
    if (ImGui::Button("reset all")) {
        work_.state.settings = work_.state.ofPreset;
    }
    work_.places.note("reset all");
    tooltip("Resets all settings to the preset.");
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.5F);
    ImGui::InputTextWithHint("find", "diffuse, thickness, ...", &filter_);
    work_.places.note("find");
    tooltip("Shows only the settings that match.");
    settingControls(work_.state.settings, work_.state.ofPreset, filter_, work_.places);
}

void Panels::fitFalseColorRange() {
    const auto& values = work_.live().values;
    if (!values || values->data.empty()) {
        return;
    }
    float low = values->data.front();
    float high = low;
    for (size_t i = 0; i < values->data.size(); i += values->channels.size()) {
        low = std::min(low, values->data[i]);
        high = std::max(high, values->data[i]);
    }
    work_.state.low = low;
    work_.state.high = std::max(high, low + 1e-6F);
}

void Panels::showPanel() {
    if (ImGui::BeginCombo("image", work_.state.show.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const Show& show : shows()) {
            if (ImGui::Selectable(show.name.data(), show.name == work_.state.show)) {
                work_.state.show = show.name;
            }
            tooltip(std::string(show.description));
        }
        ImGui::EndCombo();
    }
    work_.places.note("image");
    tooltip(std::string(findShow(work_.state.show).description));
    ImGui::Checkbox("false colours", &work_.state.falseColor);
    work_.places.note("false colours");
    tooltip("Colour map of the first channel: black, violet, red, orange to pale yellow.");
    if (work_.state.falseColor) {
        ImGui::SameLine();
        if (ImGui::Button("fit")) {
            fitFalseColorRange();
        }
        tooltip("Sets the range to the smallest and largest value of this frame.");
        const float step = std::max((work_.state.high - work_.state.low) * 0.01F, 1e-5F);
        ImGui::DragFloatRange2("range", &work_.state.low, &work_.state.high, step, 0.0F, 0.0F, "%.4g");
    }
    if (!work_.live().problem.empty()) {
        wrappedText(problemColor, work_.live().problem);
    }
}

void Panels::timesPanel() {
    if (!times_.frames().empty()) {
        std::vector<float> times(times_.frames().begin(), times_.frames().end());
        const float most = *std::ranges::max_element(times);
        ImGui::PlotLines("##times", times.data(), int(times.size()), 0, fmt::format("{:.1f} ms", times.back()).c_str(),
                         0.0F, most * 1.1F, {ImGui::GetContentRegionAvail().x, 60.0F});
        tooltip("Time of each frame, from submission to completion.");
    }
    ImGui::Text("device memory: %s", megabytes(work_.published.deviceMemory).c_str());
    ImGui::SliderFloat("resolution", &work_.state.scale, 0.1F, 2.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    work_.places.note("resolution");
    tooltip("Resolution scale: rendered pixels per window pixel, along each side. Lower: faster, blurrier.");
    ImGui::SliderFloat("frames/s", &work_.state.mostFrames, 0.0F, 240.0F,
                       work_.state.mostFrames > 0.0F ? "%.0f" : "no limit", ImGuiSliderFlags_AlwaysClamp);
    work_.places.note("frame limit");
    tooltip("Frame rate limit; 0: no limit.");
    passTable();
}

void Panels::passTable() {
    if (ImGui::BeginTable("passes", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        for (const PassHistory& pass : times_.passes()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(pass.name.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.2f ms", pass.mean);
        }
        ImGui::EndTable();
    }
}

void Panels::messages() {
    if (!work_.published.shaderProblem.empty()) {
        wrappedText(problemColor, "A shader does not compile; its last working version is still in use.");
        wrappedText(problemColor, work_.published.shaderProblem);
    }
    if (!work_.problem().empty()) {
        wrappedText(problemColor, work_.problem());
    } else if (!work_.notice().empty()) {
        wrappedText(quietColor, work_.notice());
    }
}

// With a heading that folds it away. comesIntoView: opens it, and scrolls to it.
void Panels::section(const char* title, const Folding& how, const std::function<void()>& panel) {
    if (how.comesIntoView) {
        ImGui::SetNextItemOpen(true);
    }
    const bool open = ImGui::CollapsingHeader(title, how.startsOpen ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    work_.places.note(title);
    if (how.comesIntoView) {
        ImGui::SetScrollHereY(0.0F);
    }
    if (open) {
        ImGui::PushID(title);
        panel();
        ImGui::PopID();
    }
}

void Panels::draw() {
    const uvec2 window = window_.size();
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    const auto height = static_cast<float>(window.y);
    ImGui::SetNextWindowSizeConstraints({200.0F, height}, {0.8F * static_cast<float>(window.x), height});
    ImGui::SetNextWindowSize({work_.state.panelWidth * window_.scale(), height}, ImGuiCond_Appearing);
    ImGui::Begin("Reflet", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
    work_.state.panelWidth = ImGui::GetWindowWidth() / window_.scale();
    runPanel();
    switchesPanel();
    messages();
    section("Settings", {.startsOpen = true}, [&] { settingsPanel(); });
    section("Light", {}, [&] { light_.draw(); });
    section("Camera", {}, [&] { camera_.draw(); });
    section("Show", {.startsOpen = true}, [&] { showPanel(); });
    section("Compare", {.startsOpen = true}, [&] { compare_.draw(); });
    section("Pixel", {.comesIntoView = pixel_.takeOpensPanel()}, [&] { pixel_.drawPanel(); });
    section("Times", {}, [&] { timesPanel(); });
    section("Files", {.startsOpen = true}, [&] { files_.draw(); });
    ImGui::TextColored(quietColor, "F1: keys");
    ImGui::End();
}

}  // namespace reflet
