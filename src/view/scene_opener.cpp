// Opens scenes and other files.
#include "view/scene_opener.h"

#include "base/error.h"
#include "base/json.h"
#include "scene/focus.h"
#include "scene/view_file.h"
#include "view/saved_state.h"

#include <algorithm>
#include <filesystem>

namespace reflet {

namespace {

bool givesView(const SceneOptions& source) {
    return !source.camera.empty() || !source.viewFile.empty() || !source.environment.empty() ||
           !source.background.empty() || source.placing.any() || source.time.has_value();
}

bool givesSettings(const SceneOptions& source) {
    return !source.preset.empty() || !source.settingsFiles.empty() || !source.set.empty() ||
           source.exposure.has_value();
}

}  // namespace

void SceneOpener::open(const SceneOptions& source, bool restores) {
    render_.post(fmt::format("opening {}", source.scene), RenderThread::AtEnd::drop,
                 [this, source, restores](RenderThread::Work& work) {
                     auto session = std::make_unique<Session>(work.device, source);
                     const OpenScene opened = session->opened();
                     const uint64_t number = work.replace(std::move(session));
                     return [this, opened, number, source, restores] { showScene(opened, number, source, restores); };
                 });
}

void SceneOpener::showScene(const OpenScene& opened, uint64_t number, const SceneOptions& source, bool restores) {
    ViewerState next = work_.state;
    next.source = source;
    next.view = opened.firstView;
    if (restores) {
        try {
            ViewerState restored = next;
            restoreState(restored, {.view = !givesView(source), .settings = !givesSettings(source)});
            checkFocus(restored.view.camera, *opened.scene, "camera.focus of the saved state");
            next = restored;
        } catch (const Error& error) {
            printWarning(fmt::format("{}; the scene opens without its saved state", error.what()));
        }
    }
    if (work_.opened.scene) {
        saver_.save();
        work_.tell(fmt::format("{}: opened", source.scene));
    }
    next.window = work_.state.window;
    work_.state = next;
    work_.opened = opened;
    work_.sceneNumber = number;
    work_.published.right = nullptr;
    onScene_();
}

void SceneOpener::openFile(const std::string& file) {
    if (file.empty()) {
        fail("type the name of a file to open, or choose one with browse");
    }
    const std::filesystem::path path = std::filesystem::absolute(file);
    const std::string extension = path.extension().string();
    if (extension == ".exr") {
        work_.state.compare.with = CompareWith::file;
        work_.state.compare.file = path.string();
        work_.tell(fmt::format("{}: shown on the right side", path.filename().string()));
    } else if (extension == ".hdr") {
        applyViewJson({{"environment", {{"image", path.string()}}}}, path, work_.state.view);
        work_.tell(fmt::format("{}: used as environment", path.filename().string()));
    } else if (extension == ".json") {
        openJson(path);
    } else {
        SceneOptions source;
        source.scene = file.starts_with("builtin:") ? file : path.string();
        source.size = work_.state.source.size;
        source.strict = work_.state.source.strict;
        open(source, true);
    }
}

// Settings and views have names in common, such as probes: the file is what it is valid as. If it is neither, the error
// is that of the kind which more of its names belong to.
void SceneOpener::openJson(const std::filesystem::path& path) {
    const nlohmann::json json = parseJsonFile(path);
    Settings settings = work_.state.settings;
    std::string notSettings;
    try {
        applySettingsJson(settings, json, path.string());
    } catch (const Error& error) {
        notSettings = error.what();
    }
    if (notSettings.empty()) {
        work_.state.settings = settings;
        work_.tell(fmt::format("{}: settings loaded", path.filename().string()));
        return;
    }
    try {
        View view = work_.state.view;
        applyViewJson(json, path, view);
        checkFocus(view.camera, work_.scene(), path.string() + ": camera.focus");
        work_.state.view = view;
        work_.tell(fmt::format("{}: view loaded", path.filename().string()));
    } catch (const Error& error) {
        const auto isGroup = [](const std::string& name) {
            return std::ranges::any_of(settingEntries(),
                                       [&](const SettingEntry& e) { return e.name.starts_with(name + "."); });
        };
        size_t groups = 0;
        for (const auto& [name, value] : json.items()) {
            groups += json.is_object() && (isGroup(name) || name.find('.') != std::string::npos) ? 1 : 0;
        }
        fail("{}", 2 * groups > json.size() ? notSettings : error.what());
    }
}

}  // namespace reflet
