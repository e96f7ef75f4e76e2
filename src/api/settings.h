// The settings of the effects that the library has, under the names that the program has for them.
#pragma once

#include "base/setting_table.h"
#include "lighting/host_images.h"
#include "lighting/settings.h"

#include <string_view>

namespace reflet::api {

struct Settings : LightingSettings {
    InputSettings input;
};

const SettingTable& settingTable();

/// Throws UsageError for a preset that the library does not have.
void applyPreset(Settings& settings, std::string_view name);

}  // namespace reflet::api
