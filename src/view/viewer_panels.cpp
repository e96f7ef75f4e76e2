// The panels on the left.
#include "base/json_text.h"
#include "renderer/presets.h"
#include "scene/builtin.h"
#include "scene/view_file.h"
#include "view/saved_state.h"
#include "view/switches.h"
#include "view/viewer.h"

#include "base/error.h"
#include "base/file.h"

#include <imgui.h>
#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

const ImVec4 problemColor(1.0F, 0.45F, 0.4F, 1.0F);
const ImVec4 changedColor(1.0F, 0.78F, 0.35F, 1.0F);
const ImVec4 quietColor(0.65F, 0.68F, 0.72F, 1.0F);

std::vector<std::string> presetNames() {
    std::vector<std::string> names;
    std::ranges::transform(presets(), std::back_inserter(names), &Preset::name);
    return names;
}

void wrapped(const ImVec4& color, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

std::string megabytes(uint64_t bytes) {
    return fmt::format("{:.0f} MiB", double(bytes) / double(1 << 20));
}

bool section(const char* title, bool open = false) {
    return ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

}  // namespace

// How far the image is.
std::string Viewer::progressText() const {
    const Shown& shown = *now_.live;
    if (const std::string job = render_.busyWith(); !job.empty()) {
        return job;
    }
    if (state_.running == Running::paused) {
        return fmt::format("frame {}, paused", shown.frames);
    }
    if (now_.effort.isReduced()) {
        return fmt::format("moving: resolution x {:.2f}{}", now_.effort.scale, now_.effort.fewRays ? ", 1 ray" : "");
    }
    return shown.frames >= shown.framesToConverge ? fmt::format("frame {}, converged", shown.frames)
                                                  : fmt::format("refining {}/{}", shown.frames, shown.framesToConverge);
}

void Viewer::runPanel() {
    int running = static_cast<int>(state_.running);
    ImGui::RadioButton("on demand", &running, int(Running::onDemand));
    places_.note("on demand");
    tooltip("Renders after a change until the image has converged.");
    ImGui::SameLine();
    ImGui::RadioButton("continuous", &running, int(Running::continuous));
    places_.note("continuous");
    tooltip("Renders all the time (C).");
    ImGui::SameLine();
    ImGui::RadioButton("pause", &running, int(Running::paused));
    places_.note("pause");
    tooltip("Renders nothing (space). Panels still work.");
    state_.running = static_cast<Running>(running);
    ImGui::SameLine();
    if (ImGui::Button("step")) {
        ++steps_;
    }
    places_.note("step");
    tooltip("Renders one frame (.).");
    const uvec2 size = renderSize();
    ImGui::TextColored(quietColor, "%ux%u, %s", size.x, size.y, progressText().c_str());
    if (const std::optional<float> stops = now_.live->exposure) {
        ImGui::TextColored(quietColor, "automatic exposure: %+.2f stops", double(*stops));
    }
    if (!scene().animations.empty()) {
        ImGui::Checkbox("play animations", &state_.plays);
        places_.note("play");
        auto time = static_cast<float>(state_.view.time);
        if (ImGui::DragFloat("time [s]", &time, 0.02F, 0.0F, 1e6F, "%.2f", ImGuiSliderFlags_AlwaysClamp)) {
            state_.view.time = double(time);
        }
    }
}

void Viewer::switchesPanel() {
    for (const Switch& part : switches()) {
        bool on = part.isOn(state_.settings);
        if (ImGui::Checkbox(part.name, &on)) {
            part.set(state_.settings, on, state_.ofPreset);
        }
        places_.note(fmt::format("switch {}", part.name));
        tooltip(fmt::format("{} Key {}.", part.help, static_cast<char>(part.key)));
        if (&part != &switches().back()) {
            ImGui::SameLine();
        }
    }
    if (const std::string off = switchedOff(state_.settings, state_.ofPreset); !off.empty()) {
        ImGui::TextColored(changedColor, "off: %s", off.c_str());
    }
}

void Viewer::settingsPanel() {
    std::string preset = state_.preset;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.5F);
    if (chooseName("preset", presetNames(), preset)) {
        applyPresetNamed(preset);
    }
    places_.note("preset");
    const std::vector<Preset> all = presets();
    const auto described = std::ranges::find(all, state_.preset, &Preset::name);
    tooltip(described == all.end() ? "" : described->description);
    ImGui::SameLine();
    if (ImGui::Button("reset all")) {
        state_.settings = state_.ofPreset;
    }
    places_.note("reset all");
    tooltip("Resets all settings to the preset.");
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.5F);
    ImGui::InputTextWithHint("find", "diffuse, thickness, ...", &filter_);
    places_.note("find");
    tooltip("Shows only the settings that match.");
    settingControls(state_.settings, state_.ofPreset, filter_, places_);
}

void Viewer::showPanel() {
    if (ImGui::BeginCombo("image", state_.show.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const Show& show : shows()) {
            if (ImGui::Selectable(show.name.data(), show.name == state_.show)) {
                state_.show = show.name;
            }
            tooltip(std::string(show.description));
        }
        ImGui::EndCombo();
    }
    places_.note("image");
    tooltip(std::string(findShow(state_.show).description));
    ImGui::Checkbox("false colours", &state_.falseColor);
    places_.note("false colours");
    tooltip("Colour map of the first channel: black, violet, red, orange to pale yellow.");
    if (state_.falseColor) {
        ImGui::SameLine();
        if (ImGui::Button("fit")) {
            chooseFalseColorRange();
        }
        tooltip("Sets the range to the smallest and largest value of this frame.");
        const float step = std::max((state_.high - state_.low) * 0.01F, 1e-5F);
        ImGui::DragFloatRange2("range", &state_.low, &state_.high, step, 0.0F, 0.0F, "%.4g");
    }
    if (!now_.live->problem.empty()) {
        wrapped(problemColor, now_.live->problem);
    }
}

void Viewer::comparePanel() {
    Compare& c = state_.compare;
    int with = static_cast<int>(c.with);
    const std::array<const char*, 4> names{"nothing", "preset", "EXR file", "truth"};
    const std::array<const char*, 4> labels{"nothing", "preset", "EXR file", "ground truth"};
    const std::array<const char*, 4> help{"Shows one image.", "Live, with the settings of another preset.",
                                          "An image file, as written by reflet render or reflet reference.",
                                          "This view, path traced in the background."};
    for (int i = 0; i < 4; ++i) {
        ImGui::RadioButton(labels[i], &with, i);
        places_.note(fmt::format("compare {}", names[i]));
        tooltip(help[i]);
        if (i < 3) {
            ImGui::SameLine();
        }
    }
    c.with = static_cast<CompareWith>(with);
    if (c.with == CompareWith::nothing) {
        return;
    }
    if (c.with == CompareWith::preset) {
        chooseName("right side", presetNames(), c.preset);
        places_.note("right preset");
    } else if (c.with == CompareWith::file) {
        ImGui::InputText("file", &fileName_);
        if (ImGui::IsItemDeactivatedAfterEdit()) {
            c.file = fileName_;
        }
    } else {
        const uint32_t one = 1;
        const uint32_t most = 4096;
        ImGui::SliderScalar("samples", ImGuiDataType_U32, &c.samples, &one, &most, "%u", ImGuiSliderFlags_Logarithmic);
        tooltip("Maximum samples per pixel.");
        if (compare_.samples() < c.samples) {
            const uint32_t next = CompareView::nextSamples(compare_.samples(), c.samples);
            ImGui::ProgressBar(compare_.progress(), {-1.0F, 0.0F},
                               fmt::format("{} samples: {:.0f} %", next, 100.0 * double(compare_.progress())).c_str());
        }
    }
    wrapped(compare_.failed() ? problemColor : quietColor, compare_.message());
    if (compare_.error()) {
        ImGui::Text("HDR-FLIP %.4f   relative MSE %.5f   bias %+.1f %%", compare_.error()->flip,
                    compare_.error()->relativeMse, 100.0 * compare_.error()->bias);
        tooltip("Error of the left side against the right one, computed in the background.");
        ImGui::Checkbox("error map on the right", &c.errorImage);
        places_.note("error image");
        tooltip("HDR-FLIP of each pixel in false colours, instead of the right image.");
    }
    ImGui::TextColored(quietColor, "Drag the divider in the image; X shows one side alone.");
}

void Viewer::timesPanel() {
    if (!frameTimes_.empty()) {
        std::vector<float> times(frameTimes_.begin(), frameTimes_.end());
        const float most = *std::ranges::max_element(times);
        ImGui::PlotLines("##times", times.data(), int(times.size()), 0, fmt::format("{:.1f} ms", times.back()).c_str(),
                         0.0F, most * 1.1F, {ImGui::GetContentRegionAvail().x, 60.0F});
        tooltip("Time of each frame, from submission to completion.");
    }
    ImGui::Text("device memory: %s", megabytes(now_.deviceMemory).c_str());
    ImGui::SliderFloat("resolution", &state_.scale, 0.1F, 2.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    places_.note("resolution");
    tooltip("Resolution scale: rendered pixels per window pixel, along each side. Lower: faster, blurrier.");
    ImGui::SliderFloat("frames/s", &state_.mostFrames, 0.0F, 240.0F, state_.mostFrames > 0.0F ? "%.0f" : "no limit",
                       ImGuiSliderFlags_AlwaysClamp);
    places_.note("frame limit");
    tooltip("Frame rate limit; 0: no limit.");
    if (ImGui::BeginTable("passes", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        for (const PassHistory& pass : passes_) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(pass.name.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.2f ms", pass.mean);
        }
        ImGui::EndTable();
    }
}

void Viewer::filesPanel() {
    const float button = ImGui::GetContentRegionAvail().x * 0.5F - ImGui::GetStyle().ItemSpacing.x;
    if (ImGui::Button("copy command line", {button, 0.0F})) {
        handleKey({'C', true});
    }
    places_.note("copy command line");
    tooltip(
        "Copies a command that renders this image to the clipboard (Ctrl+C). Its view file is kept in the "
        "configuration folder.");
    ImGui::SameLine();
    if (ImGui::Button("browse", {button, 0.0F})) {
        const std::filesystem::path scene = state_.source.scene;
        browser_.open(scene.has_parent_path() ? scene.parent_path() : std::filesystem::current_path());
    }
    places_.note("browse");
    tooltip("Lists the files that can be opened: scenes, environments, images to compare with, settings, views.");
    ImGui::InputTextWithHint("file##save", "name.png, .exr, .json", &openName_);
    places_.note("file name");
    const auto labelled = [&](const char* label, const char* help, const std::function<void()>& work) {
        if (ImGui::Button(label, {button, 0.0F})) {
            attempt(work);
        }
        places_.note(label);
        tooltip(help);
    };
    labelled("screenshot",
             "Writes the same PNG or EXR file as reflet render for this state. Default name: the next free one in the "
             "current folder (Ctrl+S).",
             [&] { takeScreenshot(openName_); });
    ImGui::SameLine();
    labelled(
        "open",
        "Opens a scene (.gltf, .glb, builtin:NAME), an EXR to compare with, an environment (.hdr), settings or a view "
        "(.json). Dragging it onto the window does the same.",
        [&] { openFile(openName_); });
    labelled("save settings", "Writes all settings that differ from the defaults, in the form of --settings.", [&] {
        if (openName_.empty()) {
            fail("type the name of a .json file to save to");
        }
        writeFileAtomically(openName_, jsonText(settingsJson(state_.settings, Settings{}), 2) + "\n");
        tell(fmt::format("Written: {}", openName_));
    });
    ImGui::SameLine();
    labelled("save view", "Writes camera, light and time, in the form of --view-file.", [&] {
        if (openName_.empty()) {
            fail("type the name of a .json file to save to");
        }
        writeFileAtomically(openName_, jsonText(viewJson(state_.view), 2) + "\n");
        tell(fmt::format("Written: {}", openName_));
    });
    std::string scene = state_.source.scene;
    std::vector<std::string> names;
    std::ranges::transform(builtinScenes(), std::back_inserter(names),
                           [](const BuiltinScene& s) { return fmt::format("builtin:{}", s.name); });
    if (chooseName("scene", names, scene)) {
        attempt([&] { openFile(scene); });
    }
    places_.note("scene");
}

void Viewer::messages() {
    if (!now_.shaderProblem.empty()) {
        wrapped(problemColor, "A shader does not compile; its last working version is still in use.");
        wrapped(problemColor, now_.shaderProblem);
    }
    if (!problem_.empty()) {
        wrapped(problemColor, problem_);
    } else if (!notice_.empty()) {
        wrapped(quietColor, notice_);
    }
}

void Viewer::drawPanel() {
    const uvec2 window = window_.size();
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    const auto height = static_cast<float>(window.y);
    ImGui::SetNextWindowSizeConstraints({200.0F, height}, {0.8F * static_cast<float>(window.x), height});
    ImGui::SetNextWindowSize({state_.panelWidth * window_.scale(), height}, ImGuiCond_Appearing);
    ImGui::Begin("Reflet", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
    state_.panelWidth = ImGui::GetWindowWidth() / window_.scale();
    runPanel();
    switchesPanel();
    messages();
    const std::array<std::pair<const char*, void (Viewer::*)()>, 8> sections{{{"Settings", &Viewer::settingsPanel},
                                                                              {"Light", &Viewer::lightPanel},
                                                                              {"Camera", &Viewer::cameraPanel},
                                                                              {"Show", &Viewer::showPanel},
                                                                              {"Compare", &Viewer::comparePanel},
                                                                              {"Pixel", &Viewer::pixelPanel},
                                                                              {"Times", &Viewer::timesPanel},
                                                                              {"Files", &Viewer::filesPanel}}};
    for (const auto& [title, panel] : sections) {
        const bool pixel = panel == &Viewer::pixelPanel && opensPixel_;
        if (pixel) {
            ImGui::SetNextItemOpen(true);
            opensPixel_ = false;
        }
        const bool open = section(title, panel == &Viewer::settingsPanel || panel == &Viewer::showPanel ||
                                             panel == &Viewer::comparePanel || panel == &Viewer::filesPanel);
        places_.note(title);
        if (pixel) {
            ImGui::SetScrollHereY(0.0F);
        }
        if (open) {
            ImGui::PushID(title);
            (this->*panel)();
            ImGui::PopID();
        }
    }
    ImGui::TextColored(quietColor, "F1: keys");
    ImGui::End();
}

void Viewer::drawUi() {
    places_.clear();
    if (state_.panels) {
        drawPanel();
    }
    if (const std::optional<std::string> chosen = browser_.draw(places_)) {
        attempt([&] { openFile(*chosen); });
    }
    drawDivider();
    drawRay();
    drawLegends();
    if (state_.help) {
        helpOverlay();
    }
}

}  // namespace reflet
