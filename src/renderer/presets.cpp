// Reads the embedded presets.
#include "renderer/presets.h"

#include "base/error.h"
#include "base/json_text.h"
#include "base/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace reflet {

namespace {

/// Presets to render with, that of finished pictures first, then in the order of time and error; all others show single
/// methods.
constexpr std::array<std::string_view, 6> toRenderWith{"still", "fast", "balanced", "quality", "hybrid", "pathtrace"};

std::string_view presetName(const EmbeddedFile& file) {
    return file.name.substr(0, file.name.find('.'));
}

auto rankOf(const Preset& preset) {
    return std::ranges::find(toRenderWith, preset.name) - toRenderWith.begin();
}

}  // namespace

std::vector<Preset> presets() {
    std::vector<Preset> all;
    for (const EmbeddedFile& embedded : embeddedPresets()) {
        auto json = parseOrderedJson(embedded.text);
        const auto description = json.at("description").get<std::string>();
        json.erase("description");
        const std::string name(presetName(embedded));
        const bool study = std::ranges::find(toRenderWith, name) == toRenderWith.end();
        all.push_back({name, description, jsonText(json), study});
    }
    std::ranges::stable_sort(all, {}, rankOf);
    return all;
}

void applyPreset(Settings& settings, std::string_view name) {
    const auto all = embeddedPresets();
    const auto found = std::ranges::find(all, name, presetName);
    if (found == all.end()) {
        std::vector<std::string> names;
        std::ranges::transform(all, std::back_inserter(names),
                               [](const auto& p) { return std::string(presetName(p)); });
        std::string snake(name);  // version 0.1: screen-only, screen+probes
        std::ranges::replace_if(
            snake, [](char letter) { return letter == '-' || letter == '+'; }, '_');
        if (snake != name && std::ranges::find(names, snake) != names.end()) {
            failUsage("preset '{}' is called '{}' now", name, snake);
        }
        failUsage("no preset is called '{}'{}; there are: {}", name, suggestion(name, names), fmt::join(names, ", "));
    }
    applySettingsJson(settings, parseJson(found->text), fmt::format("preset {}", name));
}

}  // namespace reflet
