// Reads and writes settings by name, from the tables.
#include "renderer/settings.h"

#include "base/error.h"
#include "base/json_text.h"
#include "base/message.h"
#include "base/text.h"
#include "renderer/draw_gbuffer/draw_gbuffer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace reflet {

namespace {

// Settings that had another name in version 0.1, in snake_case. Those that were only in camelCase need no line.
constexpr std::pair<std::string_view, std::string_view> renamedSettings[] = {
    {"depth.buffer", "depth.format"},
    {"diffuse.radius", "diffuse.max_distance"},
    {"diffuse.scale", "diffuse.downsample"},
    {"environment.lost_share", "environment.occluded_weight"},
    {"planar.find", "planar.auto_detect"},
    {"planar.first", "planar.before_screen"},
    {"shadow.clean", "shadow.denoise"},
    {"specular.rougher", "specular.rough_fallback"},
    {"specular.scale", "specular.downsample"},
    {"temporal.deviations", "temporal.clip"},
    {"trace_screen.reject_facing_away", "trace_screen.reject_backfaces"},
    {"trace_screen.smallest_step", "trace_screen.min_step"},
    {"trace_screen.thickness_from", "trace_screen.thickness_mode"},
};

SettingTable makeTable() {
    SettingTable table("reflet list settings");
    table.add<MaterialsSettings>("materials", offsetIn<Settings>(&Settings::materials));
    table.add<DepthSettings>("depth", offsetIn<Settings>(&Settings::depth));
    table.add<ShadowSettings>("shadow", offsetIn<Settings>(&Settings::shadow));
    table.add<ContactSettings>("contact", offsetIn<Settings>(&Settings::contact));
    table.add<DirectSettings>("direct", offsetIn<Settings>(&Settings::direct));
    table.add<TraceScreenSettings>("trace_screen", offsetIn<Settings>(&Settings::traceScreen));
    table.add<TraceSceneSettings>("trace_scene", offsetIn<Settings>(&Settings::traceScene));
    table.add<RadianceCacheSettings>("radiance_cache", offsetIn<Settings>(&Settings::radianceCache));
    table.add<ProbesSettings>("probes", offsetIn<Settings>(&Settings::probes));
    table.add<PlanarSettings>("planar", offsetIn<Settings>(&Settings::planar));
    table.add<LiveSettings>("live", offsetIn<Settings>(&Settings::live));
    table.add<EnvironmentSettings>("environment", offsetIn<Settings>(&Settings::environment));
    table.add<AoSettings>("ao", offsetIn<Settings>(&Settings::ao));
    table.add<DiffuseSettings>("diffuse", offsetIn<Settings>(&Settings::diffuse));
    table.add<SpecularSettings>("specular", offsetIn<Settings>(&Settings::specular));
    table.add<DenoiseSettings>("denoise", offsetIn<Settings>(&Settings::denoise));
    table.add<CompositeSettings>("composite", offsetIn<Settings>(&Settings::composite));
    table.add<BlendSettings>("blend", offsetIn<Settings>(&Settings::blend));
    table.add<TransmissionSettings>("transmission", offsetIn<Settings>(&Settings::transmission));
    table.add<AccumulateSettings>("accumulate", offsetIn<Settings>(&Settings::accumulate));
    table.add<TemporalSettings>("temporal", offsetIn<Settings>(&Settings::temporal));
    table.add<DofSettings>("dof", offsetIn<Settings>(&Settings::dof));
    table.add<MotionBlurSettings>("motion_blur", offsetIn<Settings>(&Settings::motionBlur));
    table.add<TonemapSettings>("tonemap", offsetIn<Settings>(&Settings::tonemap));
    table.rename(renamedSettings);
    return table;
}

// A text names a choice; a number or a switch in quotation marks keeps them, and is refused.
std::string valueText(const nlohmann::json& value, const SettingInfo& info) {
    return value.is_string() && info.type == SettingType::choice ? value.get<std::string>() : jsonText(value);
}

// Where an effect has no setting in the file, nothing else would notice that there is no such effect.
void checkEffect(const std::string& effect) {
    std::vector<std::string> effects;
    for (const SettingEntry& entry : settingEntries()) {
        if (const std::string name = entry.name.substr(0, entry.name.find('.'));
            std::ranges::find(effects, name) == effects.end()) {
            effects.push_back(name);
        }
    }
    if (std::ranges::find(effects, effect) == effects.end()) {
        failUsage("no effect is called '{}'; there are: {}{}", oneLine(effect), fmt::join(effects, ", "),
                  suggestion(effect, effects));
    }
}

void applyEffectJson(Settings& settings, const std::string& effect, const nlohmann::json& values) {
    checkEffect(effect);
    if (!values.is_object()) {
        failUsage("{}: must be an object of settings, is {}", effect, jsonText(values));
    }
    for (const auto& [name, value] : values.items()) {
        const SettingEntry& entry = findSetting(fmt::format("{}.{}", effect, name));
        setSetting(settings, entry.name, valueText(value, entry.info));
    }
}

}  // namespace

bool tracesScene(const Settings& settings) {
    return settings.traceScene.enabled != 0 || settings.shadow.filter == ShadowFilter::traced;
}

namespace {

bool lampsCastShadows(const ShadowSettings& shadow) {
    return shadow.filter == ShadowFilter::traced || (shadow.filter != ShadowFilter::none && shadow.lamps > 0);
}

}  // namespace

bool lightsByEmitters(const Settings& settings) {
    return settings.direct.emitters != 0 && settings.diffuse.rays > 0 && lampsCastShadows(settings.shadow);
}

uint32_t mostReflectedSuns(const Settings& settings) {
    return settings.materials.lambertOnly == 0 && lampsCastShadows(settings.shadow) ? settings.direct.reflectedSuns : 0;
}

const SettingTable& settingTable() {
    static const SettingTable table = makeTable();
    return table;
}

const std::vector<SettingEntry>& settingEntries() {
    return settingTable().entries();
}

const SettingEntry& findSetting(std::string_view name) {
    return settingTable().find(name);
}

bool sameSettings(const Settings& a, const Settings& b) {
    return std::ranges::all_of(settingEntries(), [&](const SettingEntry& entry) {
        return loadSetting(&a, entry.info) == loadSetting(&b, entry.info);
    });
}

nlohmann::ordered_json settingsJson(const Settings& settings, const Settings& from) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const SettingEntry& entry : settingEntries()) {
        if (loadSetting(&settings, entry.info) == loadSetting(&from, entry.info)) {
            continue;
        }
        const std::string text = settingText(settings, entry);
        const std::string effect = entry.name.substr(0, entry.name.find('.'));
        json[effect][entry.info.name] =
            entry.info.type == SettingType::choice ? nlohmann::ordered_json(text) : parseOrderedJson(text);
    }
    return json;
}

void setSetting(Settings& settings, std::string_view name, const std::string& value) {
    settingTable().set(&settings, name, value);
}

void setSetting(Settings& settings, std::string_view assignment) {
    const size_t equals = assignment.find('=');
    if (equals == std::string_view::npos) {
        failUsage("--set wants KEY=VALUE, is '{}'", assignment);
    }
    setSetting(settings, assignment.substr(0, equals), std::string(assignment.substr(equals + 1)));
}

std::string settingText(const Settings& settings, const SettingEntry& entry) {
    return settingText(static_cast<const void*>(&settings), entry.info);
}

void applySettingsJson(Settings& settings, const nlohmann::json& json, const std::string& where) {
    if (!json.is_object()) {
        fail(R"({}: settings must be an object: {{"effect": {{"name": value}}}})", where);
    }
    for (const auto& [effect, values] : json.items()) {
        if (effect == "description" && values.is_string()) {
            continue;
        }
        try {
            applyEffectJson(settings, effect, values);
        } catch (const UsageError& error) {
            fail("{}: {}", where, error.what());
        }
    }
}

}  // namespace reflet
