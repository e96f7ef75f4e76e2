// Writes the command line.
#include "view/render_command.h"

#include "base/file.h"
#include "base/json_text.h"
#include "cli/command_line.h"
#include "scene/default_light.h"
#include "scene/view_file.h"
#include "view/saved_state.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace reflet {

namespace {

namespace fs = std::filesystem;

// Writes the view to a permanent file, named after its content so that copied command lines stay valid.
std::string keptViewFile(const std::string& scene, const View& view) {
    const std::string text = jsonText(viewJson(view), 2) + "\n";
    const fs::path file =
        configurationFolder() / "views" / fmt::format("{}-{}.json", sceneStem(scene), fingerprintOf(text));
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    writeFileAtomically(file, text);
    return file.string();
}

// Of the view that the scene and these options give.
std::string viewArguments(const SceneOptions& source) {
    std::string line;
    if (!source.viewFile.empty()) {
        line += " --view-file " + shellWord(fs::absolute(source.viewFile).string());
    }
    if (!source.environment.empty()) {
        line += " --environment " + shellWord(isMadeEnvironment(source.environment) || source.environment == "none"
                                                  ? source.environment
                                                  : fs::absolute(source.environment).string());
    }
    if (!source.background.empty()) {
        line += " --background " + shellWord(source.background);
    }
    if (source.time) {
        line += fmt::format(" --time {}", *source.time);
    }
    return line;
}

}  // namespace

std::string sceneStem(const std::string& scene) {
    return scene.starts_with("builtin:") ? scene.substr(8) : fs::path(scene).stem().string();
}

std::string renderCommand(const Workspace& work) {
    const ViewerState& state = work.state;
    const uvec2 size = work.renderSize();
    const SceneOptions& source = state.source;
    std::string line = "reflet render " + shellWord(source.scene);
    if (source.sceneIndex) {
        line += fmt::format(" --scene {}", *source.sceneIndex);
    }
    if (!source.variant.empty()) {
        line += " --variant " + shellWord(source.variant);
    }
    line += fmt::format(" --size {}x{}", size.x, size.y);
    line += " --preset " + shellWord(state.preset);  // without one, render makes a still
    for (const SettingEntry& entry : settingEntries()) {
        const std::string value = settingText(state.settings, entry);
        if (value != settingText(state.ofPreset, entry)) {
            line += fmt::format(" --set {}", shellWord(entry.name + "=" + value));
        }
    }
    if (!source.camera.empty()) {
        line += " --camera " + shellWord(source.camera);
    }
    line += work.opened.isDefaultView(state, size)
                ? viewArguments(source)
                : " --view-file " + shellWord(keptViewFile(source.scene, state.view));
    if (source.seed != 0) {
        line += fmt::format(" --seed {}", source.seed);
    }
    if (state.show != "final") {
        line += " --show " + state.show;
    }
    return line + fmt::format(" -o {}.png", shellWord(sceneStem(source.scene)));
}

}  // namespace reflet
