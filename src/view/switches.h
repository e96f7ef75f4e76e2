// Switches for the parts of the light, by their common names: shortcuts for settings.
#pragma once

#include "renderer/settings.h"

#include <span>
#include <string>

namespace reflet {

struct Switch {
    const char* name;
    int key;           ///< keyboard key, as a character
    const char* help;  ///< which settings it changes
    bool (*isOn)(const Settings&);
    /// preset: source of the setting's value when switched on, unless it is also off in the preset.
    void (*set)(Settings& settings, bool on, const Settings& preset);
};

std::span<const Switch> switches();

/// "SSGI, AO": names of switches that are off in `settings` and on in the preset; empty: none.
std::string switchedOff(const Settings& settings, const Settings& preset);

}  // namespace reflet
