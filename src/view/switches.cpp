// The parts of the light.
#include "view/switches.h"

#include <array>

namespace reflet {

std::span<const Switch> switches() {
    static const std::array<Switch, 5> all{{
        {"direct", '1', "Direct light and emission (composite.direct); indirect light stays.",
         [](const Settings& s) { return s.composite.direct != 0; },
         [](Settings& s, bool on, const Settings&) { s.composite.direct = on ? 1 : 0; }},
        {"SSGI", '2', "Indirect diffuse light, also from the fallbacks (diffuse.rays).",
         [](const Settings& s) { return s.diffuse.rays > 0; },
         [](Settings& s, bool on, const Settings& preset) {
             s.diffuse.rays = !on ? 0 : preset.diffuse.rays > 0 ? preset.diffuse.rays : 1;
         }},
        {"SSR", '3', "Reflections, also from the fallbacks (specular.rays).",
         [](const Settings& s) { return s.specular.rays > 0; },
         [](Settings& s, bool on, const Settings& preset) {
             s.specular.rays = !on ? 0 : preset.specular.rays > 0 ? preset.specular.rays : 1;
         }},
        {"AO", '4', "Ambient occlusion (ao.method).", [](const Settings& s) { return s.ao.method != AoMethod::none; },
         [](Settings& s, bool on, const Settings& preset) {
             s.ao.method = !on                                  ? AoMethod::none
                           : preset.ao.method != AoMethod::none ? preset.ao.method
                                                                : AoMethod::bitmask;
         }},
        {"shadows", '5', "Shadows of the sun and of lamps (shadow.filter).",
         [](const Settings& s) { return s.shadow.filter != ShadowFilter::none; },
         [](Settings& s, bool on, const Settings& preset) {
             s.shadow.filter = !on                                          ? ShadowFilter::none
                               : preset.shadow.filter != ShadowFilter::none ? preset.shadow.filter
                                                                            : ShadowFilter::pcss;
         }},
    }};
    return all;
}

std::string switchedOff(const Settings& settings, const Settings& preset) {
    std::string names;
    for (const Switch& s : switches()) {
        if (!s.isOn(settings) && s.isOn(preset)) {
            names += (names.empty() ? "" : ", ") + std::string(s.name);
        }
    }
    return names;
}

}  // namespace reflet
