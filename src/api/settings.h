// The settings of the effects that the library has, under the names that the program has for them.
#pragma once

#include "base/setting_table.h"
#include "lighting/host_images.h"
#include "lighting/settings.h"

#include <string_view>
#include <vector>

namespace reflet::api {

struct Settings : LightingSettings {
    InputSettings input;
};

const SettingTable& settingTable();
/// Entries of the table that affect the library. The others may be set, too, as presets and files contain them.
const std::vector<SettingEntry>& listedSettings();

/// Throws UsageError for a preset that the library does not have.
void applyPreset(Settings& settings, std::string_view name);

}  // namespace reflet::api
