// Procedural scenes for tests, documentation and first steps; they need no files.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <span>
#include <string_view>

namespace reflet {

struct BuiltinScene {
    std::string_view name;         ///< as in `builtin:NAME`
    std::string_view description;  ///< one line: its contents and its purpose
    Scene (*make)();               ///< deterministic, bit for bit
};

/// All of them, in display order.
std::span<const BuiltinScene> builtinScenes();

/// nullptr if there is none of that name.
const BuiltinScene* findBuiltinScene(std::string_view name);

/// One of the list, or "tessellated-N": a room of N triangles that looks the same for every N. N is 100 times the
/// square of a number from 1 to 100. Or "motion-NAME": a scene of `reflet bench --motions`. Both are for benchmarks and
/// not in the list. nullopt if there is none of that name.
std::optional<Scene> makeBuiltinScene(std::string_view name);

}  // namespace reflet
