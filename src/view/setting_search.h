// Search in the settings panel.
#pragma once

#include "renderer/settings.h"

#include <string_view>

namespace reflet {

/// Whether a setting is found by what somebody typed: each word is part of its name, begins a word of its help, or is
/// a common term for its group ("ssr", "reflection", "gi", "blur", "taa"). Upper and lower case are the same.
bool isFound(const SettingEntry& entry, std::string_view typed);

}  // namespace reflet
