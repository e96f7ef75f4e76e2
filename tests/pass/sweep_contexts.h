// In which frame each setting makes a difference, for sweeps over all settings.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::test::sweep_test {

/// What a setting needs in order to be read.
struct Context {
    std::string_view setting;       ///< its name, or the start of it
    std::vector<std::string> with;  ///< assignments, "group.key=value"
    const char* scene = "gloss";    ///< a built-in scene, or one that the sweep makes itself
    uint32_t frames = 1;
    float moved = 0.0F;  ///< how far the camera moves before the last frame [m]
};

/// The context whose start of a name fits the setting's and is the longest.
const Context& contextOf(const std::string& setting);

}  // namespace reflet::test::sweep_test
