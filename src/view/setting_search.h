// Search in the settings panel.
#pragma once

#include "renderer/settings.h"

#include <string_view>

namespace reflet {

/// Whether a setting matches the search text: each word is part of its name, begins a word of its help, or is a common
/// term for its group ("ssr", "reflection", "gi", "blur", "taa"). Case-insensitive.
bool isFound(const SettingEntry& entry, std::string_view typed);

}  // namespace reflet
