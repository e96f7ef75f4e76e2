// The scenes that are made by code: what tests, pictures and first steps use, without any file.
#pragma once

#include "scene/scene.h"

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

}  // namespace reflet
