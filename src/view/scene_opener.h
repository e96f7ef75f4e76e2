// Opens scenes and other files.
#pragma once

#include "view/state_saver.h"
#include "view/workspace.h"

#include <filesystem>
#include <functional>
#include <string>

namespace reflet {

class SceneOpener {
public:
    /// onScene: called once another scene is open, to discard data of the previous one.
    SceneOpener(Workspace& work, RenderThread& render, StateSaver& saver, std::function<void()> onScene)
        : work_(work), render_(render), saver_(saver), onScene_(std::move(onScene)) {}

    /// Opens a scene in the background; the current one stays open until then. restores: restores its saved state.
    void open(const SceneOptions& source, bool restores);
    /// A scene, an EXR to compare with, an environment, settings or a view. Throws Error.
    void openFile(const std::string& file);

private:
    void showScene(const OpenScene& opened, uint64_t number, const SceneOptions& source, bool restores);
    void openJson(const std::filesystem::path& path);

    Workspace& work_;
    RenderThread& render_;
    StateSaver& saver_;
    std::function<void()> onScene_;
};

}  // namespace reflet
