// Switches for the parts of the light, by the names that people know them by: short cuts for settings.
#pragma once

#include "renderer/settings.h"

#include <span>
#include <string>

namespace reflet {

struct Switch {
    const char* name;
    int key;           ///< of the keyboard, as a character
    const char* help;  ///< what it sets
    bool (*isOn)(const Settings&);
    /// preset: what the setting is while it is on, unless it is off there, too.
    void (*set)(Settings& settings, bool on, const Settings& preset);
};

std::span<const Switch> switches();

/// "SSGI, AO": names of those that are off here and on in the preset; empty: none.
std::string switchedOff(const Settings& settings, const Settings& preset);

}  // namespace reflet
