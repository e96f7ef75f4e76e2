// Makes the variants of a report or bench.
#include "measure/variants.h"

#include "base/error.h"
#include "renderer/presets.h"

#include <algorithm>

namespace reflet {

namespace {

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    while (true) {
        const size_t end = text.find(separator);
        parts.emplace_back(text.substr(0, end));
        if (end == std::string_view::npos) {
            return parts;
        }
        text.remove_prefix(end + 1);
    }
}

Variant parseVariant(const std::string& text, const SceneOptions& shared) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        failUsage("--variant must be NAME=KEY=VALUE,… or NAME=PRESET,KEY=VALUE,…, is '{}'", text);
    }
    return {text.substr(0, equals), settingsOfList(text.substr(equals + 1), shared, "--variant " + text)};
}

}  // namespace

Settings settingsOfList(const std::string& list, const SceneOptions& shared, const std::string& where) {
    constexpr std::string_view presetPrefix = "preset:";
    SceneOptions options = shared;
    Settings settings;
    std::vector<std::string> parts = split(list, ',');
    const auto isPreset = [](const std::string& part) { return part.find('=') == std::string::npos; };
    const auto rest = std::ranges::find_if_not(parts, isPreset);
    for (auto preset = parts.begin(); preset != rest; ++preset) {
        applyPreset(settings, preset->starts_with(presetPrefix) ? preset->substr(presetPrefix.size()) : *preset);
    }
    if (const auto late = std::find_if(rest, parts.end(), isPreset); late != parts.end()) {
        failUsage("{}: '{}' is not KEY=VALUE; a preset must come first", where, *late);
    }
    options.set.insert(options.set.end(), rest, parts.end());
    changeSettings(settings, options);
    return settings;
}

std::vector<Variant> makeVariants(const std::vector<std::string>& presets, const std::vector<std::string>& own,
                                  const SceneOptions& shared) {
    std::vector<Variant> variants;
    for (const std::string& preset : presets) {
        SceneOptions options = shared;
        options.preset = preset;
        variants.push_back({preset, loadSettings(options)});
    }
    for (const std::string& text : own) {
        variants.push_back(parseVariant(text, shared));
    }
    for (auto variant = variants.begin(); variant != variants.end(); ++variant) {
        if (std::find_if(variants.begin(), variant, [&](const Variant& v) { return v.name == variant->name; }) !=
            variant) {
            failUsage("two variants are called '{}': give each --variant a unique name", variant->name);
        }
    }
    return variants;
}

std::string changedSettings(const Settings& settings) {
    const Settings defaults;
    std::vector<std::string> changed;
    for (const SettingEntry& entry : settingEntries()) {
        if (const std::string text = settingText(settings, entry); text != settingText(defaults, entry)) {
            changed.push_back(entry.name + "=" + text);
        }
    }
    return fmt::format("{}", fmt::join(changed, " "));
}

}  // namespace reflet
