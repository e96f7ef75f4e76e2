#pragma once

#include "renderer/presets.h"
#include "renderer/settings.h"
#include "scene/builtin.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::test {

/// Names of the built-in scenes that sweeps run with. By default four that need every pass together: planar mirrors,
/// glass, moving things, lamps. All of them if the environment variable REFLET_ALL_SCENES is set (.ci/full).
inline std::vector<std::string> sweptScenes() {
    constexpr std::array<const char*, 4> some{"mirror-hall", "glass", "moving", "lamps"};
    if (std::getenv("REFLET_ALL_SCENES") == nullptr) {  // NOLINT(concurrency-mt-unsafe): one thread
        return {some.begin(), some.end()};
    }
    std::vector<std::string> all;
    std::ranges::transform(builtinScenes(), std::back_inserter(all),
                           [](const BuiltinScene& scene) { return std::string(scene.name); });
    return all;
}

/// A preset's settings, but for the sides of probes and shadow maps: large ones take most of the time of a small frame.
/// Their ends are swept apart.
inline Settings smallPreset(std::string_view name) {
    Settings settings;
    applyPreset(settings, name);
    settings.probes.resolution = 16;
    settings.shadow.resolution = std::min(settings.shadow.resolution, 256U);
    settings.shadow.lampResolution = std::min(settings.shadow.lampResolution, 64U);
    return settings;
}

/// A scene's name as part of a test's name.
inline std::string nameInTests(std::string scene) {
    std::ranges::replace(scene, '-', '_');
    return scene;
}

}  // namespace reflet::test
