// Saves and restores the viewer's state.
#include "view/saved_state.h"

#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/json_text.h"
#include "capture/fingerprint.h"
#include "renderer/presets.h"
#include "scene/view_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <span>
#include <utility>

namespace reflet {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

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
T valueOf(const std::array<std::pair<T, const char*>, N>& names, const ordered_json& json, const char* key,
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

void fromJson(const ordered_json& json, const fs::path& file, const Restore& what, ViewerState& state) {
    if (what.view && json.contains("view")) {
        applyViewJson(nlohmann::json(json["view"]), file, state.view);
    }
    if (what.settings && json.contains("preset")) {
        Settings settings;
        applyPreset(settings, json["preset"].get<std::string>());
        state.ofPreset = settings;
        applySettingsJson(settings, nlohmann::json(json.value("settings", ordered_json::object())), file.string());
        state.preset = json["preset"].get<std::string>();
        state.settings = settings;
    }
    state.running = valueOf(runningNames, json, "running", state.running);
    state.plays = json.value("plays", state.plays);
    const ordered_json show = json.value("show", ordered_json::object());
    state.show = show.value("name", state.show);
    state.falseColor = show.value("false_color", state.falseColor);
    state.low = show.value("low", state.low);
    state.high = show.value("high", state.high);
    state.scale = std::clamp(json.value("scale", state.scale), 0.1F, 2.0F);
    state.mostFrames = std::clamp(json.value("most_frames", state.mostFrames), 0.0F, 1000.0F);
    const ordered_json compare = json.value("compare", ordered_json::object());
    Compare& c = state.compare;
    c.with = valueOf(compareNames, compare, "with", c.with);
    c.preset = compare.value("preset", c.preset);
    c.file = compare.value("file", c.file);
    c.samples = std::clamp(compare.value("samples", c.samples), 1U, 65536U);
    c.divider = std::clamp(compare.value("divider", c.divider), 0.0F, 1.0F);
    c.errorImage = compare.value("error_image", c.errorImage);
    state.panels = json.value("panels", state.panels);
    state.panelWidth = std::clamp(json.value("panel_width", state.panelWidth), 200.0F, 2000.0F);
    if (json.contains("window")) {
        state.window = glm::clamp(uvec2(json["window"].at(0).get<uint32_t>(), json["window"].at(1).get<uint32_t>()),
                                  uvec2(320, 200), uvec2(16384));
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
    const char* home = std::getenv("HOME");
    return fs::path(home != nullptr ? home : ".") / ".config" / "reflet";
}

fs::path stateFile(const std::string& scene) {
    const std::string key = sceneKey(scene);
    std::string name = scene.starts_with("builtin:") ? "builtin-" + key.substr(8) : fs::path(key).stem().string();
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_'; }, '_');
    // Files of the same name can be in different folders.
    return configurationFolder() / "view" / fmt::format("{}-{}.json", name, fingerprintOf(key));
}

std::string stateText(const ViewerState& state) {
    return jsonText(toJson(state), 2) + "\n";
}

bool restoreState(ViewerState& state, const Restore& what) {
    const fs::path file = stateFile(state.source.scene);
    if (!fs::exists(file)) {
        return false;
    }
    ViewerState restored = state;
    try {
        fromJson(ordered_json(parseJsonFile(file)), file, what, restored);
    } catch (const nlohmann::json::exception& error) {
        fail("{}: {}", file.string(), error.what());
    }
    state = restored;
    return true;
}

}  // namespace reflet
