// Scene, view, size and settings as options name them.
#include "job/scene_options.h"

#include "base/color.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/json_text.h"
#include "base/message.h"
#include "base/text.h"
#include "renderer/presets.h"
#include "scene/background.h"
#include "scene/builtin.h"
#include "scene/closed_room.h"
#include "scene/default_light.h"
#include "scene/focus.h"
#include "scene/framing.h"
#include "scene/gltf/gltf.h"
#include "scene/sky.h"
#include "scene/thin_meshes.h"
#include "scene/view_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace reflet {

namespace {

constexpr std::string_view builtinPrefix = "builtin:";

Scene makeBuiltin(std::string_view name) {
    if (std::optional<Scene> builtin = makeBuiltinScene(name)) {
        return std::move(*builtin);
    }
    std::vector<std::string> names;
    std::ranges::transform(builtinScenes(), std::back_inserter(names),
                           [](const BuiltinScene& b) { return std::string(b.name); });
    failUsage("no built-in scene is called '{}'; available: {}{}", name, fmt::join(names, ", "),
              suggestion(name, names));
}

const Camera& findCamera(const Scene& scene, const std::string& wanted) {
    size_t index = 0;
    const char* end = wanted.data() + wanted.size();
    const auto [rest, error] = std::from_chars(wanted.data(), end, index);
    if (error == std::errc() && rest == end && index < scene.cameras.size()) {
        return scene.cameras[index];
    }
    const auto found = std::ranges::find(scene.cameras, wanted, &Camera::name);
    if (found == scene.cameras.end()) {
        std::vector<std::string> names;
        for (size_t i = 0; i < scene.cameras.size(); ++i) {
            names.push_back(fmt::format("{} '{}'", i, scene.cameras[i].name));
        }
        failUsage("the scene has no camera '{}'; its cameras: {}", wanted, listed(names));
    }
    return *found;
}

// stated: the view file.
void chooseLight(const SceneOptions& options, const Scene& scene, const nlohmann::json& stated, View& view) {
    const Background background = options.background.empty() ? view.background : parseBackground(options.background);
    const bool keepsLight = stated.contains("sun") || stated.contains("environment");
    if (!options.environment.empty()) {
        chooseEnvironment(view, {.name = options.environment, .base = {}, .keepsSun = stated.contains("sun")});
    } else if (!keepsLight && !options.scene.starts_with(builtinPrefix)) {
        if (const auto added = addDefaultLight(scene, view)) {
            printNote(fmt::format("{}: {}; choose with --environment sky|studio|none|FILE", options.scene, *added));
        }
    }
    if (!options.background.empty() || stated.contains("background")) {
        view.background = background;
    }
}

Camera cameraOf(const SceneOptions& options, const Scene& scene) {
    if (!options.camera.empty()) {
        return findCamera(scene, options.camera);
    }
    const uvec2 size = parseSize(options.size);
    return defaultView(scene, float(size.x) / float(size.y)).camera;
}

/// What the camera sees of a closed room would be black.
void lightClosedRoom(const SceneOptions& options, Scene& scene) {
    const float strength = scene.sun ? luminance(scene.sun->irradiance) : Sky::sunLuminance;
    if (const auto lamp = lampForClosedRoom(scene, cameraOf(options, scene), strength)) {
        scene.lamps.push_back(*lamp);
        printNote(fmt::format("{}: no light reaches what the camera sees: added a lamp inside", options.scene));
    }
}

/// Points and lines are a pixel wide for the camera that the options name; a view file's other cameras see them as wide
/// as they are then.
void widenThin(const SceneOptions& options, Scene& scene) {
    if (std::ranges::all_of(scene.meshes, [](const Mesh& mesh) { return mesh.outward.empty(); })) {
        return;
    }
    widenThinMeshes(scene, cameraOf(options, scene), parseSize(options.size).y);
}

// Says which of several animations of the same thing plays.
void noteClips(const Scene& scene) {
    const auto playing = std::ranges::find(scene.clips, true, &AnimationClip::plays);
    const auto still = std::ranges::count(scene.clips, false, &AnimationClip::plays);
    if (still > 0 && playing != scene.clips.end()) {
        printNote(
            fmt::format("{} other animation{} of what '{}' moves {} not play: --animation NAME, or --animation list",
                        still, still == 1 ? "" : "s", playing->name, still == 1 ? "does" : "do"));
    }
}

}  // namespace

void printWarning(const std::string& message) {
    printMessage("warning:", message);
}

void printNote(const std::string& message) {
    if (isQuiet()) {
        return;
    }
    printMessage("note:", message);
}

Scene loadScene(const SceneOptions& options) {
    if (options.scene.starts_with(builtinPrefix)) {
        if (options.sceneIndex.value_or(0) != 0) {
            failUsage("--scene {}: a built-in scene is one scene", *options.sceneIndex);
        }
        if (!options.variant.empty()) {
            failUsage("--variant {}: a built-in scene has no material variants", options.variant);
        }
        if (!options.animation.empty()) {
            failUsage("--animation {}: all animations of a built-in scene play", options.animation);
        }
        return makeBuiltin(std::string_view(options.scene).substr(builtinPrefix.size()));
    }
    if (options.sceneIndex && *options.sceneIndex < 0) {
        failUsage("--scene must be 0 or more, is {}", *options.sceneIndex);
    }
    Scene scene = loadGltf(options.scene, {.scene = options.sceneIndex.value_or(-1),
                                           .variant = options.variant,
                                           .animation = options.animation,
                                           .zUp = options.up == "Z",
                                           .warn = printWarning,
                                           .strict = options.strict});
    if (options.animation.empty()) {
        noteClips(scene);
    }
    widenThin(options, scene);
    lightClosedRoom(options, scene);
    return scene;
}

View loadView(const SceneOptions& options, const Scene& scene) {
    const uvec2 size = parseSize(options.size);
    const float aspect = float(size.x) / float(size.y);
    View view = defaultView(scene, aspect);
    const Camera made = view.camera;
    if (!options.camera.empty()) {
        view.camera = findCamera(scene, options.camera);
    }
    nlohmann::json stated = nlohmann::json::object();
    if (!options.viewFile.empty()) {
        stated = parseJsonFile(options.viewFile);
        applyViewJson(stated, options.viewFile, view);
        checkFocus(view.camera, scene, options.viewFile + ": camera.focus");
    }
    if (options.time) {
        if (!(*options.time >= 0.0 && *options.time <= View::largestTime)) {
            failUsage("--time must be 0 to {:g} seconds, is {}", View::largestTime, *options.time);
        }
        view.time = *options.time;
    }
    const bool isFirst = options.camera.empty() && view.camera == made;
    const bool automatic = isFirst && (scene.cameras.empty() || options.placing.wholeTurn);
    if (isFirst && scene.cameras.empty() && view.time > 0.0) {
        view.camera = framingCamera(scene, aspect, view.time);  // what is animated is elsewhere then
    }
    placeCamera(options.placing, scene, aspect, automatic, view);
    placeSun(options.placing, view);
    chooseLight(options, scene, stated, view);
    if (!options.placing.sun.empty() && !(luminance(view.sun.irradiance) > 0.0F)) {
        view.sun.irradiance = defaultSun(view.camera).irradiance;  // there was none to turn
    }
    if (!options.saveView.empty()) {
        writeFileAtomically(options.saveView, jsonText(viewJson(view), 2) + "\n");
    }
    return view;
}

uvec2 parseSize(const std::string& text) {
    uvec2 size(0);
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.x);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.y);
        if (height.ec == std::errc() && height.ptr == end && size.x > 0 && size.y > 0) {
            return size;
        }
    }
    failUsage("--size must be WIDTHxHEIGHT in pixels, both at least 1, is '{}'", text);
}

void changeSettings(Settings& settings, const SceneOptions& options) {
    for (const std::string& file : options.settingsFiles) {
        applySettingsJson(settings, parseJsonFile(file), file);
    }
    for (const std::string& assignment : options.set) {
        setSetting(settings, assignment);
    }
    if (options.exposure) {
        setSetting(settings, fmt::format("tonemap.exposure={}", *options.exposure));
    }
}

Settings loadSettings(const SceneOptions& options) {
    Settings settings;
    applyPreset(settings, options.preset.empty() ? defaultPreset : options.preset);
    changeSettings(settings, options);
    return settings;
}

}  // namespace reflet
