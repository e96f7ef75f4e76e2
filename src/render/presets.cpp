// The presets.
#include "render/presets.h"

#include "base/error.h"
#include "base/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace reflet {

namespace {

constexpr std::array all{
    Preset{"default", "what is used when nothing is said", "{}"},
    Preset{"direct", "direct light and hard shadows only", R"({"diffuse": {"rays": 0}, "specular": {"rays": 0}})"},
    Preset{"fast", "one short diffuse ray per pixel",
           R"({"diffuse": {"rays": 1}, "trace_screen": {"maxSteps": 16, "step": 0.3, "thickness": 0.5}})"},
    Preset{"quality", "many rays in small steps: slow, little noise",
           R"({"diffuse": {"rays": 32}, "trace_screen": {"maxSteps": 200, "step": 0.05, "thickness": 0.2}})"},
};

}  // namespace

std::span<const Preset> presets() {
    return all;
}

void applyPreset(Settings& settings, std::string_view name) {
    const auto* found = std::ranges::find(all, name, &Preset::name);
    if (found == all.end()) {
        std::vector<std::string> names;
        std::ranges::transform(all, std::back_inserter(names), [](const Preset& p) { return std::string(p.name); });
        failUsage("no preset is called '{}'; there are: {}{}", name, fmt::join(names, ", "), suggestion(name, names));
    }
    applySettingsJson(settings, nlohmann::json::parse(found->json), fmt::format("preset {}", name));
}

}  // namespace reflet
