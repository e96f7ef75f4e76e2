// Saves and restores the viewer's state.
#include "view/saved_state.h"

#include "base/ascii.h"
#include "base/error.h"
#include "base/home.h"
#include "base/json.h"
#include "base/json_text.h"
#include "base/message.h"
#include "capture/show.h"
#include "job/fingerprint.h"
#include "job/scene_options.h"
#include "renderer/presets.h"
#include "scene/view_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace reflet {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double largestWindow = 8192.0;  // along a side; a device may take minutes to draw a larger one
const uvec2 smallestWindow(320, 200);
constexpr size_t longestName = 100;  // of a scene, in a file name, which may have 255 bytes

constexpr std::array<std::pair<Running, const char*>, 3> runningNames{
    {{Running::onDemand, "on demand"}, {Running::continuous, "continuous"}, {Running::paused, "paused"}}};
constexpr std::array<std::pair<CompareWith, const char*>, 4> compareNames{{{CompareWith::nothing, "nothing"},
                                                                           {CompareWith::preset, "preset"},
                                                                           {CompareWith::file, "file"},
                                                                           {CompareWith::truth, "truth"}}};

template <class T, size_t N>
std::string nameOf(const std::array<std::pair<T, const char*>, N>& names, T value) {
    return std::ranges::find(names, value, &std::pair<T, const char*>::first)->second;
}

template <class T, size_t N>
T valueOf(const std::array<std::pair<T, const char*>, N>& names, const nlohmann::json& json, const char* key,
          T standard) {
    const auto found = std::ranges::find(names, json.value(key, std::string()),
                                         [](const std::pair<T, const char*>& p) { return std::string(p.second); });
    return found == names.end() ? standard : found->first;
}

// The same key for every path to one file.
std::string sceneKey(const std::string& scene) {
    return scene.starts_with("builtin:") ? scene : fs::weakly_canonical(fs::absolute(scene)).string();
}

ordered_json toJson(const ViewerState& state) {
    Settings ofPreset;
    applyPreset(ofPreset, state.preset);
    ordered_json json;
    json["scene"] = sceneKey(state.source.scene);
    json["preset"] = state.preset;
    json["settings"] = settingsJson(state.settings, ofPreset);
    json["view"] = viewJson(state.view);
    json["running"] = nameOf(runningNames, state.running);
    json["plays"] = state.plays;
    json["show"] = {{"name", state.show}, {"false_color", state.falseColor}, {"low", state.low}, {"high", state.high}};
    json["scale"] = state.scale;
    json["most_frames"] = state.mostFrames;
    const Compare& c = state.compare;
    json["compare"] = {{"with", nameOf(compareNames, c.with)},
                       {"preset", c.preset},
                       {"file", c.file},
                       {"samples", c.samples},
                       {"divider", c.divider},
                       {"error_image", c.errorImage}};
    json["panels"] = state.panels;
    json["panel_width"] = state.panelWidth;
    json["window"] = {state.window.x, state.window.y};
    return json;
}

/// The number of this key, if there is one.
template <class T>
void readNumber(const JsonNode& node, const char* key, double min, double max, T& number) {
    if (const auto value = node.find(key)) {
        number = static_cast<T>(value->number(min, max));
    }
}

/// The name of this key, if there is one; must be one of `names`, which gives an Error that lists them.
void readName(const JsonNode& node, const char* key, const std::function<void(const std::string&)>& check,
              std::string& name) {
    if (const auto value = node.find(key)) {
        if (!value->json().is_string()) {
            value->complainMustBe("a text");
        }
        const std::string wanted = value->json().get<std::string>();
        try {
            check(wanted);
        } catch (const Error& error) {
            value->complain(error.what());
        }
        name = wanted;
    }
}

/// An object of this key, or an empty one.
JsonNode part(const JsonNode& root, const char* key) {
    static const nlohmann::json none = nlohmann::json::object();
    const auto found = root.find(key);
    if (found && !found->json().is_object()) {
        found->complainMustBe("an object");
    }
    return found ? *found : JsonNode(none, "");
}

void fromJson(const nlohmann::json& json, const fs::path& file, const Restore& what, ViewerState& state) {
    const JsonNode root(json, file);
    if (!json.is_object()) {
        root.complainMustBe("an object");
    }
    if (what.view && json.contains("view")) {
        applyViewJson(json["view"], file, state.view);
    }
    if (what.settings && json.contains("preset")) {
        Settings settings;
        applyPreset(settings, json["preset"].get<std::string>());
        state.ofPreset = settings;
        applySettingsJson(settings, part(root, "settings").json(), file.string());
        state.preset = json["preset"].get<std::string>();
        state.settings = settings;
    }
    state.running = valueOf(runningNames, json, "running", state.running);
    state.plays = json.value("plays", state.plays);
    const JsonNode show = part(root, "show");
    readName(
        show, "name", [](const std::string& name) { (void)findShow(name); }, state.show);
    state.falseColor = show.json().value("false_color", state.falseColor);
    readNumber(show, "low", -1e30, 1e30, state.low);
    readNumber(show, "high", -1e30, 1e30, state.high);
    readNumber(root, "scale", 0.1, 2.0, state.scale);
    readNumber(root, "most_frames", 0.0, 1000.0, state.mostFrames);
    const JsonNode compare = part(root, "compare");
    Compare& c = state.compare;
    c.with = valueOf(compareNames, compare.json(), "with", c.with);
    readName(
        compare, "preset",
        [](const std::string& name) {
            Settings ignored;
            applyPreset(ignored, name);
        },
        c.preset);
    c.file = compare.json().value("file", c.file);
    readNumber(compare, "samples", 1.0, 65536.0, c.samples);
    readNumber(compare, "divider", 0.0, 1.0, c.divider);
    c.errorImage = compare.json().value("error_image", c.errorImage);
    state.panels = json.value("panels", state.panels);
    readNumber(root, "panel_width", 200.0, 2000.0, state.panelWidth);
    if (const auto window = root.find("window")) {
        const std::vector<double> size = window->numbers(2, 0.0, largestWindow, "pixels");
        state.window = glm::max(uvec2(size[0], size[1]), smallestWindow);
    }
}

}  // namespace

std::string fingerprintOf(const std::string& text) {
    Fingerprint sum;
    sum.add(std::as_bytes(std::span(text)));
    return sum.text();
}

fs::path configurationFolder() {
    const char* configured = std::getenv("XDG_CONFIG_HOME");
    if (configured != nullptr && *configured != '\0') {
        return fs::path(configured) / "reflet";
    }
    if (const auto home = homeFolder()) {
        return *home / ".config" / "reflet";
    }
    fail("there is no home folder: set XDG_CONFIG_HOME or HOME to keep the window's state");
}

fs::path stateFile(const std::string& scene) {
    const std::string key = sceneKey(scene);
    std::string name = scene.starts_with("builtin:") ? "builtin-" + key.substr(8) : fs::path(key).stem().string();
    std::ranges::replace_if(
        name, [](char c) { return !isAsciiAlphanumeric(c) && c != '-' && c != '_'; }, '_');
    // Files of the same name can be in different folders.
    const std::string file = fmt::format("{}-{}.json", name.substr(0, longestName), fingerprintOf(key));
    try {
        return configurationFolder() / "view" / file;
    } catch (const Error& error) {
        static std::once_flag told;
        std::call_once(told, [&] { printWarning(error.what()); });
        return "/dev/null";
    }
}

std::string stateText(const ViewerState& state) {
    return jsonText(toJson(state), 2) + "\n";
}

bool restoreState(ViewerState& state, const Restore& what) {
    const fs::path file = stateFile(state.source.scene);
    if (std::error_code ignored; !fs::is_regular_file(file, ignored)) {
        return false;
    }
    ViewerState restored = state;
    try {
        fromJson(parseJsonFile(file), file, what, restored);
    } catch (const nlohmann::json::exception& error) {
        fail("{}: {}", file.string(), oneLine(error.what()));
    }
    state = restored;
    return true;
}

}  // namespace reflet
