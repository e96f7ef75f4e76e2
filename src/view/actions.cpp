// Carries out what keys and buttons do.
#include "view/actions.h"

#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "renderer/presets.h"
#include "scene/framing.h"
#include "scene/view_file.h"
#include "view/render_command.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace reflet {

namespace {

namespace fs = std::filesystem;

void writeJson(const std::string& file, const nlohmann::ordered_json& json) {
    if (file.empty()) {
        fail("type the name of a .json file to save to");
    }
    writeFileAtomically(file, jsonText(json, 2) + "\n");
}

}  // namespace

void Actions::applyPresetNamed(const std::string& name) {
    Settings settings;
    applyPreset(settings, name);
    work_.state.preset = name;
    work_.state.ofPreset = settings;
    work_.state.settings = settings;
}

void Actions::takeScreenshot(const std::string& file) {
    const std::string extension = fs::path(file).extension().string();
    if (!file.empty() && extension != ".png" && extension != ".exr") {
        fail("{}: the name must end in .png or .exr", file);
    }
    render_.post("writing a screenshot", RenderThread::AtEnd::complete,
                 [this, file, state = work_.state, size = work_.renderSize()](RenderThread::Work& work) {
                     std::string name = file;
                     for (int i = 1; name.empty(); ++i) {
                         const std::string next = fmt::format("{}-{}.png", sceneStem(state.source.scene), i);
                         name = fs::exists(next) ? "" : next;
                     }
                     work.live->screenshot(state, size, name);
                     return [this, name] { work_.tell(fmt::format("Written: {}", fs::absolute(name).string())); };
                 });
}

void Actions::frameAll() {
    const vec2 size(work_.renderSize());
    frameScene(work_.detachedCamera(), work_.scene(), size.x / size.y, work_.state.view.time);
}

void Actions::copyCommandLine() {
    work_.attempt([&] {
        const std::string line = renderCommand(work_);
        window_.copyText(line);
        work_.tell(fmt::format("Copied: {}", line));
    });
}

void Actions::saveSettings(const std::string& file) {
    writeJson(file, settingsJson(work_.state.settings, Settings{}));
    work_.tell(fmt::format("Written: {}", file));
}

void Actions::saveView(const std::string& file) {
    writeJson(file, viewJson(work_.state.view));
    work_.tell(fmt::format("Written: {}", file));
}

}  // namespace reflet
