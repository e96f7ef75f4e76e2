// The panel for files.
#include "view/files_panel.h"

#include "scene/builtin.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <functional>

namespace reflet {

void FilesPanel::draw() {
    const float button = ImGui::GetContentRegionAvail().x * 0.5F - ImGui::GetStyle().ItemSpacing.x;
    if (ImGui::Button("copy command line", {button, 0.0F})) {
        actions_.copyCommandLine();
    }
    work_.places.note("copy command line");
    tooltip(
        "Copies a command that renders this image to the clipboard (Ctrl+C). What --orbit, --look-at, --fov and --sun "
        "cannot say is in a view file, which is kept in the configuration folder.");
    ImGui::SameLine();
    if (ImGui::Button("browse", {button, 0.0F})) {
        const std::filesystem::path scene = work_.state.source.scene;
        browser_.open(scene.has_parent_path() ? scene.parent_path() : std::filesystem::current_path());
    }
    work_.places.note("browse");
    tooltip("Lists the files that can be opened: scenes, environments, images to compare with, settings, views.");
    ImGui::InputTextWithHint("file##save", "name.png, .exr, .json", &name_);
    work_.places.note("file name");
    const auto labelled = [&](const char* label, const char* help, const std::function<void()>& work) {
        if (ImGui::Button(label, {button, 0.0F})) {
            work_.attempt(work);
        }
        work_.places.note(label);
        tooltip(help);
    };
    labelled("screenshot",
             "Writes the same PNG or EXR file as reflet render for this state. Default name: the next free one in the "
             "current folder (Ctrl+S).",
             [&] { actions_.takeScreenshot(name_); });
    ImGui::SameLine();
    labelled(
        "open",
        "Opens a scene (.gltf, .glb, builtin:NAME), an EXR to compare with, an environment (.hdr), settings or a view "
        "(.json). Dragging it onto the window does the same.",
        [&] { opener_.openFile(name_); });
    labelled("save settings", "Writes all settings that differ from the defaults, in the form of --settings.",
             [&] { actions_.saveSettings(name_); });
    ImGui::SameLine();
    labelled("save view", "Writes camera, light and time, in the form of --view-file.",
             [&] { actions_.saveView(name_); });
    chooseScene();
}

void FilesPanel::chooseScene() {
    std::string scene = work_.state.source.scene;
    std::vector<std::string> names;
    std::ranges::transform(builtinScenes(), std::back_inserter(names),
                           [](const BuiltinScene& s) { return fmt::format("builtin:{}", s.name); });
    if (chooseName("scene", names, scene)) {
        work_.attempt([&] { opener_.openFile(scene); });
    }
    work_.places.note("scene");
}

void FilesPanel::drawBrowser() {
    if (const std::optional<std::string> chosen = browser_.draw(work_.places)) {
        work_.attempt([&] { opener_.openFile(*chosen); });
    }
}

}  // namespace reflet
