// Settings of the library, and the presets of the program as far as they concern them.
#include "api/settings.h"

#include "base/embedded.h"
#include "base/error.h"
#include "base/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace reflet {
std::span<const EmbeddedFile> libraryPresets();
}  // namespace reflet

namespace reflet::api {

namespace {

SettingTable makeTable() {
    SettingTable table("refletSettingInfo");
    table.add<InputSettings>("input", offsetIn<Settings>(&Settings::input));
    table.add<ShadowSettings>("shadow", offsetIn<Settings>(&Settings::shadow));
    table.add<ContactSettings>("contact", offsetIn<Settings>(&Settings::contact));
    table.add<TraceScreenSettings>("trace_screen", offsetIn<Settings>(&Settings::traceScreen));
    table.add<EnvironmentSettings>("environment", offsetIn<Settings>(&Settings::environment));
    table.add<DiffuseSettings>("diffuse", offsetIn<Settings>(&Settings::diffuse));
    table.add<SpecularSettings>("specular", offsetIn<Settings>(&Settings::specular));
    table.add<AoSettings>("ao", offsetIn<Settings>(&Settings::ao));
    table.add<DenoiseSettings>("denoise", offsetIn<Settings>(&Settings::denoise));
    table.add<RadianceCacheSettings>("radiance_cache", offsetIn<Settings>(&Settings::radianceCache));
    table.add<TemporalSettings>("temporal", offsetIn<Settings>(&Settings::temporal));
    table.add<DofSettings>("dof", offsetIn<Settings>(&Settings::dof));
    table.add<MotionBlurSettings>("motion_blur", offsetIn<Settings>(&Settings::motionBlur));
    table.add<TonemapSettings>("tonemap", offsetIn<Settings>(&Settings::tonemap));
    return table;
}

// What a host decides by what it draws and calls.
constexpr std::array<std::string_view, 5> ofTheHost{"radiance_cache.enabled", "shadow.resolution", "shadow.extent",
                                                    "temporal.enabled", "temporal.scale"};

std::string_view presetName(const EmbeddedFile& file) {
    return file.name.substr(0, file.name.find('.'));
}

}  // namespace

const SettingTable& settingTable() {
    static const SettingTable table = makeTable();
    return table;
}

const std::vector<SettingEntry>& listedSettings() {
    static const std::vector<SettingEntry> listed = [] {
        std::vector<SettingEntry> found(settingTable().entries().begin(), settingTable().entries().end());
        std::erase_if(found,
                      [](const SettingEntry& e) { return std::ranges::find(ofTheHost, e.name) != ofTheHost.end(); });
        return found;
    }();
    return listed;
}

void applyPreset(Settings& settings, std::string_view name) {
    const auto files = libraryPresets();
    const auto found = std::ranges::find(files, name, presetName);
    if (found == files.end()) {
        std::vector<std::string> names;
        std::ranges::transform(files, std::back_inserter(names),
                               [](const auto& f) { return std::string(presetName(f)); });
        failUsage("no preset is called '{}'{}; there are: {}", name, suggestion(name, names), fmt::join(names, ", "));
    }
    const nlohmann::json preset = nlohmann::json::parse(found->text);
    for (const auto& [effect, values] : preset.items()) {
        if (!values.is_object()) {
            continue;  // the description
        }
        for (const auto& [setting, value] : values.items()) {
            const std::string full = fmt::format("{}.{}", effect, setting);
            const auto& entries = settingTable().entries();
            if (std::ranges::find(entries, full, &SettingEntry::name) != entries.end()) {
                settingTable().set(&settings, full, value.is_string() ? value.get<std::string>() : value.dump());
            }
        }
    }
}

}  // namespace reflet::api
