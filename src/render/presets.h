// Settings under one name: JSON of the same form as a settings file.
#pragma once

#include "render/settings.h"

#include <span>
#include <string_view>

namespace reflet {

struct Preset {
    std::string_view name;
    std::string_view description;
    std::string_view json;
};

std::span<const Preset> presets();

/// Throws UsageError naming the nearest.
void applyPreset(Settings& settings, std::string_view name);

}  // namespace reflet
