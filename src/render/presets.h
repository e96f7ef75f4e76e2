// Settings under one name: the JSON files in src/render/presets, which are settings files as users write them.
#pragma once

#include "base/embedded.h"
#include "render/settings.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// The files, embedded at build time, ordered by name.
std::span<const EmbeddedFile> embeddedPresets();

struct Preset {
    std::string name;
    std::string description;
    std::string json;  ///< on one line, without the description
};

std::vector<Preset> presets();

/// What programs take where nobody names another.
inline constexpr std::string_view defaultPreset = "balanced";

/// Throws UsageError naming the nearest.
void applyPreset(Settings& settings, std::string_view name);

}  // namespace reflet
