// Opens scenes and other files.
#include "view/viewer.h"

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
           !source.background.empty() || source.time.has_value();
}

bool givesSettings(const SceneOptions& source) {
    return !source.preset.empty() || !source.settingsFiles.empty() || !source.set.empty();
}

}  // namespace

// The open scene stays until the other one is there.
void Viewer::open(const SceneOptions& source, bool restores) {
    render_.post(fmt::format("opening {}", source.scene), RenderThread::AtEnd::drop,
                 [this, source, restores](RenderThread::Work& work) {
                     auto session = std::make_unique<Session>(work.device, source);
                     const OpenScene opened = session->opened();
                     const uint64_t number = work.replace(std::move(session));
                     return [this, opened, number, source, restores] { showScene(opened, number, source, restores); };
                 });
}

void Viewer::showScene(const OpenScene& opened, uint64_t number, const SceneOptions& source, bool restores) {
    ViewerState next = state_;
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
    if (opened_.scene) {
        save();
        tell(fmt::format("{}: opened", source.scene));
    }
    next.window = state_.window;
    state_ = next;
    compare_.forget();
    opened_ = opened;
    scene_ = number;
    now_.right = nullptr;
    seen_.reset();
    picked_.reset();
    window_.setTitle(fmt::format("Reflet: {}", source.scene));
}

void Viewer::openFile(const std::string& file) {
    if (file.empty()) {
        fail("type the name of a file to open, or choose one with browse");
    }
    const std::filesystem::path path = std::filesystem::absolute(file);
    const std::string extension = path.extension().string();
    if (extension == ".exr") {
        state_.compare.with = CompareWith::file;
        state_.compare.file = path.string();
        tell(fmt::format("{}: shown on the right side", path.filename().string()));
    } else if (extension == ".hdr") {
        applyViewJson({{"environment", {{"image", path.string()}}}}, path, state_.view);
        tell(fmt::format("{}: used as environment", path.filename().string()));
    } else if (extension == ".json") {
        openJson(path);
    } else {
        SceneOptions source;
        source.scene = file.starts_with("builtin:") ? file : path.string();
        source.size = state_.source.size;
        source.strict = state_.source.strict;
        open(source, true);
    }
}

// Settings and views have names in common, such as probes: the file is what it is valid as. If it is neither, the error
// is that of the kind which more of its names belong to.
void Viewer::openJson(const std::filesystem::path& path) {
    const nlohmann::json json = parseJsonFile(path);
    Settings settings = state_.settings;
    std::string notSettings;
    try {
        applySettingsJson(settings, json, path.string());
    } catch (const Error& error) {
        notSettings = error.what();
    }
    if (notSettings.empty()) {
        state_.settings = settings;
        tell(fmt::format("{}: settings loaded", path.filename().string()));
        return;
    }
    try {
        View view = state_.view;
        applyViewJson(json, path, view);
        checkFocus(view.camera, scene(), path.string() + ": camera.focus");
        state_.view = view;
        tell(fmt::format("{}: view loaded", path.filename().string()));
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
