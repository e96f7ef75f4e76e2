// Writes the command line.
#include "view/render_command.h"

#include "base/file.h"
#include "base/json_text.h"
#include "base/message.h"
#include "cli/command_line.h"
#include "scene/default_light.h"
#include "scene/json_values.h"
#include "scene/view_file.h"
#include "view/saved_state.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <filesystem>
#include <optional>

namespace reflet {

namespace {

namespace fs = std::filesystem;

/// No notes while it lives.
struct QuietWork {
    QuietWork() { setQuiet(true); }
    ~QuietWork() { setQuiet(before); }
    QuietWork(const QuietWork&) = delete;
    QuietWork& operator=(const QuietWork&) = delete;

    bool before = isQuiet();
};

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

std::string placingArguments(const CameraOptions& placing) {
    std::string line;
    const auto add = [&](const char* option, const std::string& value) {
        line += value.empty() ? "" : fmt::format(" {} {}", option, shellWord(value));
    };
    const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; };
    add("--orbit", placing.orbit);
    add("--look-at", placing.lookAt);
    add("--fov", number(placing.fov));
    add("--zoom", number(placing.zoom));
    add("--f-number", number(placing.fNumber));
    add("--focus", placing.focus);
    add("--sun", placing.sun);
    return line;
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
    return line + placingArguments(source.placing);
}

/// Made environments are equal, wherever their images are.
bool isSame(View a, const View& b) {
    a.camera.name = b.camera.name;
    if (isMadeEnvironment(a.environment.imageFile) && a.environment.imageFile == b.environment.imageFile) {
        a.environment.image = b.environment.image;
    }
    return a == b;
}

/// The options of the camera and the sun as numbers of that many digits.
CameraOptions placingOf(const View& view, const View& before, const CameraOptions& source, int digits) {
    const glm::dvec3 position(view.camera.position);
    const glm::dvec3 target(view.camera.target);
    const glm::dvec3 inFile = view.origin + target;
    const Direction from = directionOf(position - target);
    const auto joined = [&](double a, double b) { return fmt::format("{:.{}g},{:.{}g}", a, digits, b, digits); };
    CameraOptions placing = source;
    placing.lookAt = joined(inFile.x, inFile.y) + fmt::format(",{:.{}g}", inFile.z, digits);
    placing.orbit =
        joined(from.azimuth, from.elevation) + fmt::format(",{:.{}g}", glm::distance(position, target), digits);
    placing.zoom.reset();
    placing.fov.reset();
    if (source.fov || before.camera.fovY != view.camera.fovY) {
        const std::string degrees = fmt::format("{:.{}g}", double(view.camera.fovY) / radiansPerDegree, digits);
        std::from_chars(degrees.data(), degrees.data() + degrees.size(), placing.fov.emplace());
    }
    if (before.sun.direction != view.sun.direction) {
        const Direction sun = directionOf(-glm::dvec3(view.sun.direction));
        placing.sun = joined(sun.azimuth, sun.elevation);
    }
    return placing;
}

/// Of a view that differs from the one that the scene and `source` give by what --orbit, --look-at, --fov and --sun
/// say exactly; nullopt if more is changed.
std::optional<std::string> placedArguments(const SceneOptions& source, const Scene& scene, const View& view,
                                           uvec2 size) {
    if (view.camera.orthographicHeight > 0.0F || view.camera.node >= 0 || view.camera.apertureRadius > 0.0F) {
        return std::nullopt;
    }
    const QuietWork quiet;  // notes were given when the scene was opened
    SceneOptions typed = source;
    typed.size = fmt::format("{}x{}", size.x, size.y);
    typed.saveView.clear();
    const View before = loadView(typed, scene);
    for (const int digits : {9, 17}) {
        typed.placing = placingOf(view, before, source.placing, digits);
        if (isSame(loadView(typed, scene), view)) {
            return viewArguments(typed);
        }
    }
    return std::nullopt;
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
    if (work.opened.isDefaultView(state, size)) {
        line += viewArguments(source);
    } else if (const auto placed = placedArguments(source, work.scene(), state.view, size)) {
        line += *placed;
    } else {
        line += " --view-file " + shellWord(keptViewFile(source.scene, state.view));
    }
    if (source.seed != 0) {
        line += fmt::format(" --seed {}", source.seed);
    }
    if (state.show != "final") {
        line += " --show " + state.show;
    }
    return line + fmt::format(" -o {}.png", shellWord(sceneStem(source.scene)));
}

}  // namespace reflet
