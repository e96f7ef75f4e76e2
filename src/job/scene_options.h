// Command line options of what to render: scene, view, size, seed and settings.
#pragma once

#include "job/camera_options.h"
#include "renderer/settings.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace reflet {

struct SceneOptions {
    std::string scene;
    std::optional<int> sceneIndex;
    std::string variant;    ///< material variant of the glTF file; empty: its default
    std::string animation;  ///< animation of the glTF file, as in GltfOptions
    std::string up = "Y";   ///< the file's axis that points up: "Y" or "Z"
    std::string camera;
    std::string viewFile;
    CameraOptions placing;    ///< applied after the view file
    std::string environment;  ///< "sky", "studio", "none" or a file; empty: the view file's, the scene's or a default
    std::string background;   ///< as parseBackground takes it; empty: the view file's or a default
    std::optional<double> time;  ///< seconds, overrides the view file
    std::string size = "1280x720";
    std::string preset;
    std::vector<std::string> settingsFiles;
    std::vector<std::string> set;
    std::optional<double> exposure;  ///< stops, overrides all settings
    std::string saveView;            ///< view file to write
    uint32_t seed = 0;
    bool strict = false;  ///< invalid parts of a file are errors
};

/// Prints one line on standard error.
void printWarning(const std::string& message);
/// The same for information that is not a problem.
void printNote(const std::string& message);

/// A file, or `builtin:NAME`. Warnings are printed.
Scene loadScene(const SceneOptions& options);

/// The scene's view, changed by --camera, --view-file, `placing`, --environment, --background and --time. A file
/// without enough light gets a default (scene/default_light.h) and a note, unless one of these sets its light. Writes
/// the view to `saveView`, if given.
View loadView(const SceneOptions& options, const Scene& scene);

/// "1280x720". Throws UsageError.
uvec2 parseSize(const std::string& text);

/// Applies settings files, then --set, then --exposure, on top of `settings`.
void changeSettings(Settings& settings, const SceneOptions& options);

/// Preset, then settings files, then --set and --exposure, each overriding the ones before.
Settings loadSettings(const SceneOptions& options);

}  // namespace reflet
