// Presets: named sets of settings, the JSON files in src/renderer/presets, in the format of users' settings files.
#pragma once

#include "base/embedded.h"
#include "renderer/settings.h"

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
    std::string json;  ///< settings on one line, without the description
    bool study;        ///< demonstrates a single method, instead of the best quality for its cost
};

/// All presets, those for rendering first: the one for finished pictures, then from the fastest to the most exact;
/// last, those for study, by name.
std::vector<Preset> presets();

/// The preset that programs use by default.
inline constexpr std::string_view defaultPreset = "balanced";

/// Throws UsageError, suggesting the nearest name.
void applyPreset(Settings& settings, std::string_view name);

}  // namespace reflet
