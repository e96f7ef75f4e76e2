// Settings of several effects under their full names, "trace_screen.max_steps", read and written as text. The values
// are members of a struct that the caller owns.
#pragma once

#include "base/setting_info.h"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace reflet {

/// A setting with its full name and its place in the struct of all settings.
struct SettingEntry {
    std::string name;  ///< "trace_screen.max_steps"
    SettingInfo info;  ///< offset counts from the start of that struct
};

/// Bytes from the start of `Settings` to a member, which may be one of a base.
template <class Settings, class Effect, class Owner>
size_t offsetIn(Effect Owner::*member) {
    static const Settings settings{};
    const auto* const all = reinterpret_cast<const std::byte*>(&settings);
    return static_cast<size_t>(reinterpret_cast<const std::byte*>(&(settings.*member)) - all);
}

class SettingTable {
public:
    /// listedBy: what lists all settings, for messages: "reflet list settings".
    explicit SettingTable(std::string listedBy) : listedBy_(std::move(listedBy)) {}

    /// Adds the table of an effect, whose struct is `offset` bytes into the one of all settings.
    template <class Effect>
    void add(const std::string& effect, size_t offset) {
        for (SettingInfo info : settingInfos(static_cast<const Effect*>(nullptr))) {
            info.offset += offset;
            entries_.push_back({effect + "." + info.name, std::move(info)});
        }
    }

    /// Former names in snake_case, and what they are called now; for messages. Must outlive the table.
    void rename(std::span<const std::pair<std::string_view, std::string_view>> names) { renamed_ = names; }

    /// In the order in which they were added.
    [[nodiscard]] const std::vector<SettingEntry>& entries() const { return entries_; }

    /// Throws UsageError for an unknown name: says what it is called now, or names the nearest.
    [[nodiscard]] const SettingEntry& find(std::string_view name) const;

    /// Throws UsageError for an unknown name and for a value of the wrong type or out of range (stating the range).
    void set(void* settings, std::string_view name, const std::string& value) const;

private:
    std::string listedBy_;
    std::vector<SettingEntry> entries_;
    std::span<const std::pair<std::string_view, std::string_view>> renamed_;
};

/// A real number, a whole one, 0 or 1 of a switch, or the value of an option.
double loadSetting(const void* settings, const SettingInfo& info);
void storeSetting(void* settings, const SettingInfo& info, double value);

/// The value as text that SettingTable::set takes.
std::string settingText(const void* settings, const SettingInfo& info);

/// The allowed values of a setting: "0.001 to 100", "true or false", "gamma22, srgb, …".
std::string rangeText(const SettingInfo& info);

}  // namespace reflet
