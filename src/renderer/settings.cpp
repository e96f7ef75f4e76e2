// Reads and writes settings by name, from the tables.
#include "renderer/settings.h"

#include "base/error.h"
#include "base/json_text.h"
#include "base/text.h"
#include "renderer/gbuffer/draw_gbuffer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

namespace reflet {

namespace {

template <class Effect>
void addEffect(std::vector<SettingEntry>& entries, const std::string& effect, size_t offset) {
    for (SettingInfo info : settingInfos(static_cast<const Effect*>(nullptr))) {
        info.offset += offset;
        entries.push_back({effect + "." + info.name, std::move(info)});
    }
}

std::vector<SettingEntry> makeEntries() {
    std::vector<SettingEntry> entries;
    addEffect<MaterialsSettings>(entries, "materials", offsetof(Settings, materials));
    addEffect<DepthSettings>(entries, "depth", offsetof(Settings, depth));
    addEffect<ShadowSettings>(entries, "shadow", offsetof(Settings, shadow));
    addEffect<ContactSettings>(entries, "contact", offsetof(Settings, contact));
    addEffect<DirectSettings>(entries, "direct", offsetof(Settings, direct));
    addEffect<TraceScreenSettings>(entries, "trace_screen", offsetof(Settings, traceScreen));
    addEffect<TraceSceneSettings>(entries, "trace_scene", offsetof(Settings, traceScene));
    addEffect<ProbesSettings>(entries, "probes", offsetof(Settings, probes));
    addEffect<PlanarSettings>(entries, "planar", offsetof(Settings, planar));
    addEffect<LiveSettings>(entries, "live", offsetof(Settings, live));
    addEffect<EnvironmentSettings>(entries, "environment", offsetof(Settings, environment));
    addEffect<DiffuseSettings>(entries, "diffuse", offsetof(Settings, diffuse));
    addEffect<SpecularSettings>(entries, "specular", offsetof(Settings, specular));
    addEffect<DenoiseSettings>(entries, "denoise", offsetof(Settings, denoise));
    addEffect<CompositeSettings>(entries, "composite", offsetof(Settings, composite));
    addEffect<BlendSettings>(entries, "blend", offsetof(Settings, blend));
    addEffect<AccumulateSettings>(entries, "accumulate", offsetof(Settings, accumulate));
    addEffect<TemporalSettings>(entries, "temporal", offsetof(Settings, temporal));
    addEffect<TonemapSettings>(entries, "tonemap", offsetof(Settings, tonemap));
    return entries;
}

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

// What a name of version 0.1 is called now.
std::optional<std::string> newName(std::string_view old) {
    const std::string snake = snakeCase(old);
    const auto* renamed =
        std::ranges::find(renamedSettings, snake, &std::pair<std::string_view, std::string_view>::first);
    const std::string name = renamed == std::end(renamedSettings) ? snake : std::string(renamed->second);
    const bool known = std::ranges::find(settingEntries(), name, &SettingEntry::name) != settingEntries().end();
    return known ? std::optional(name) : std::nullopt;
}

std::optional<double> parseNumber(const std::string& text) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && rest == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> parseValue(const SettingInfo& info, const std::string& text) {
    if (info.type == SettingType::choice) {
        const auto option = std::ranges::find(info.options, text, &SettingOption::name);
        return option == info.options.end() ? std::nullopt : std::optional<double>(option->value);
    }
    if (info.type == SettingType::toggle) {
        if (text == "true" || text == "on" || text == "1") {
            return 1.0;
        }
        return text == "false" || text == "off" || text == "0" ? std::optional(0.0) : std::nullopt;
    }
    const auto value = parseNumber(text);
    const bool whole = info.type == SettingType::real || (value && std::floor(*value) == *value);
    // As floats, which is what limits of real settings are: 0.001 as a double is less than as a float.
    const bool real = info.type == SettingType::real;
    const double compared = value && real ? double(static_cast<float>(*value)) : value.value_or(0.0);
    return value && whole && compared >= info.lowest && compared <= info.highest ? value : std::nullopt;
}

void store(Settings& settings, const SettingInfo& info, double value) {
    auto* at = reinterpret_cast<std::byte*>(&settings) + info.offset;
    if (info.type == SettingType::real) {
        const auto real = static_cast<float>(value);
        std::memcpy(at, &real, sizeof(real));
    } else {
        const auto integer = static_cast<uint32_t>(value);
        std::memcpy(at, &integer, sizeof(integer));
    }
}

double load(const Settings& settings, const SettingInfo& info) {
    const auto* at = reinterpret_cast<const std::byte*>(&settings) + info.offset;
    if (info.type == SettingType::real) {
        float real = 0.0F;
        std::memcpy(&real, at, sizeof(real));
        return real;
    }
    uint32_t integer = 0;
    std::memcpy(&integer, at, sizeof(integer));
    return integer;
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
        failUsage("no effect is called '{}'; there are: {}{}", effect, fmt::join(effects, ", "),
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

const std::vector<SettingEntry>& settingEntries() {
    static const std::vector<SettingEntry> entries = makeEntries();
    return entries;
}

const SettingEntry& findSetting(std::string_view name) {
    const auto& entries = settingEntries();
    const auto found = std::ranges::find(entries, name, &SettingEntry::name);
    if (found == entries.end()) {
        if (const auto renamed = newName(name)) {
            failUsage("setting '{}' is called '{}' now", name, *renamed);
        }
        std::vector<std::string> names;
        std::ranges::transform(entries, std::back_inserter(names), &SettingEntry::name);
        failUsage("unknown setting '{}' (all of them: reflet list settings){}", name, suggestion(name, names));
    }
    return *found;
}

bool sameSettings(const Settings& a, const Settings& b) {
    return std::ranges::all_of(settingEntries(),
                               [&](const SettingEntry& entry) { return load(a, entry.info) == load(b, entry.info); });
}

nlohmann::ordered_json settingsJson(const Settings& settings, const Settings& from) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const SettingEntry& entry : settingEntries()) {
        if (load(settings, entry.info) == load(from, entry.info)) {
            continue;
        }
        const std::string text = settingText(settings, entry);
        const std::string effect = entry.name.substr(0, entry.name.find('.'));
        json[effect][entry.info.name] =
            entry.info.type == SettingType::choice ? nlohmann::ordered_json(text) : parseOrderedJson(text);
    }
    return json;
}

std::string rangeText(const SettingInfo& info) {
    switch (info.type) {
        case SettingType::toggle:
            return "true or false";
        case SettingType::choice: {
            std::vector<std::string> names;
            std::ranges::transform(info.options, std::back_inserter(names), &SettingOption::name);
            return fmt::format("{}", fmt::join(names, ", "));
        }
        default:
            return fmt::format("{:g} to {:g}", info.lowest, info.highest);
    }
}

void setSetting(Settings& settings, std::string_view name, const std::string& value) {
    const SettingEntry& entry = findSetting(name);
    const auto parsed = parseValue(entry.info, value);
    if (!parsed) {
        const char* kind = entry.info.type == SettingType::choice    ? "one of "
                           : entry.info.type == SettingType::integer ? "a whole number from "
                           : entry.info.type == SettingType::real    ? "a number from "
                                                                     : "";
        if (const std::string renamed = snakeCase(value); renamed != value && parseValue(entry.info, renamed)) {
            failUsage("{}: '{}' is called '{}' now", entry.name, value, renamed);
        }
        failUsage("{} must be {}{}, is '{}'", entry.name, kind, rangeText(entry.info), value);
    }
    store(settings, entry.info, *parsed);
}

void setSetting(Settings& settings, std::string_view assignment) {
    const size_t equals = assignment.find('=');
    if (equals == std::string_view::npos) {
        failUsage("--set wants KEY=VALUE, is '{}'", assignment);
    }
    setSetting(settings, assignment.substr(0, equals), std::string(assignment.substr(equals + 1)));
}

std::string settingText(const Settings& settings, const SettingEntry& entry) {
    const double value = load(settings, entry.info);
    if (entry.info.type == SettingType::choice) {
        return std::ranges::find(entry.info.options, static_cast<uint32_t>(value), &SettingOption::value)->name;
    }
    if (entry.info.type == SettingType::toggle) {
        return value != 0.0 ? "true" : "false";
    }
    return entry.info.type == SettingType::real ? fmt::format("{}", static_cast<float>(value))
                                                : fmt::format("{}", static_cast<uint32_t>(value));
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
