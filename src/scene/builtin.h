// The scenes that are made by code: what tests, pictures and first steps use, without any file.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <span>
#include <string_view>

namespace reflet {

struct BuiltinScene {
    std::string_view name;         ///< as in `builtin:NAME`
    std::string_view description;  ///< one line: what is in it and what it is for
    Scene (*make)();               ///< always the same scene, to the bit
};

/// All of them, in the order in which they are listed.
std::span<const BuiltinScene> builtinScenes();

/// nullptr: there is none of that name.
const BuiltinScene* findBuiltinScene(std::string_view name);

/// One of the list, or "tessellated-N": a room that looks the same with any number N of triangles, which is 100 times
/// the square of 1 to 100. That one is for measuring alone and not in the list. None: there is none of that name.
std::optional<Scene> makeBuiltinScene(std::string_view name);

}  // namespace reflet
