// Reads and writes settings by name.
#include "base/setting_table.h"

#include "base/error.h"
#include "base/message.h"
#include "base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

namespace reflet {

namespace {

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

}  // namespace

const SettingEntry& SettingTable::find(std::string_view name) const {
    const auto known = [&](std::string_view wanted) {
        return std::ranges::find(entries_, wanted, &SettingEntry::name);
    };
    if (const auto found = known(name); found != entries_.end()) {
        return *found;
    }
    const std::string snake = snakeCase(name);
    const auto renamed = std::ranges::find(renamed_, snake, &std::pair<std::string_view, std::string_view>::first);
    const std::string now = renamed == renamed_.end() ? snake : std::string(renamed->second);
    if (known(now) != entries_.end()) {
        failUsage("setting '{}' is called '{}' now", oneLine(name), now);
    }
    std::vector<std::string> names;
    std::ranges::transform(entries_, std::back_inserter(names), &SettingEntry::name);
    failUsage("unknown setting '{}' (all of them: {}){}", oneLine(name), listedBy_, suggestion(name, names));
}

void SettingTable::set(void* settings, std::string_view name, const std::string& value) const {
    const SettingEntry& entry = find(name);
    const auto parsed = parseValue(entry.info, value);
    if (!parsed) {
        const char* kind = entry.info.type == SettingType::choice    ? "one of "
                           : entry.info.type == SettingType::integer ? "a whole number from "
                           : entry.info.type == SettingType::real    ? "a number from "
                                                                     : "";
        if (const std::string renamed = snakeCase(value); renamed != value && parseValue(entry.info, renamed)) {
            failUsage("{}: '{}' is called '{}' now", entry.name, oneLine(value), renamed);
        }
        failUsage("{} must be {}{}, is '{}'", entry.name, kind, rangeText(entry.info), oneLine(value));
    }
    storeSetting(settings, entry.info, *parsed);
}

void storeSetting(void* settings, const SettingInfo& info, double value) {
    auto* at = static_cast<std::byte*>(settings) + info.offset;
    if (info.type == SettingType::real) {
        const auto real = static_cast<float>(value);
        std::memcpy(at, &real, sizeof(real));
    } else {
        const auto integer = static_cast<uint32_t>(value);
        std::memcpy(at, &integer, sizeof(integer));
    }
}

double loadSetting(const void* settings, const SettingInfo& info) {
    const auto* at = static_cast<const std::byte*>(settings) + info.offset;
    if (info.type == SettingType::real) {
        float real = 0.0F;
        std::memcpy(&real, at, sizeof(real));
        return real;
    }
    uint32_t integer = 0;
    std::memcpy(&integer, at, sizeof(integer));
    return integer;
}

std::string settingText(const void* settings, const SettingInfo& info) {
    const double value = loadSetting(settings, info);
    if (info.type == SettingType::choice) {
        return std::ranges::find(info.options, static_cast<uint32_t>(value), &SettingOption::value)->name;
    }
    if (info.type == SettingType::toggle) {
        return value != 0.0 ? "true" : "false";
    }
    return info.type == SettingType::real ? fmt::format("{}", static_cast<float>(value))
                                          : fmt::format("{}", static_cast<uint32_t>(value));
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

}  // namespace reflet
