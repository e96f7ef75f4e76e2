// The built-in scenes, one function and one file each.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace reflet::builtin {

Scene makeCubes();
Scene makeTiltedCube();
Scene makeCornell();
Scene makeCave();
Scene makeGloss();
Scene makeColonnade();
Scene makeMirrorHall();
Scene makeLamps();
Scene makeMoving();

/// The number in "tessellated-N", if it is one that makeTessellated takes.
std::optional<uint32_t> tessellatedTriangles(std::string_view name);
/// 100 times the square of 1 to 100.
Scene makeTessellated(uint32_t triangles);

}  // namespace reflet::builtin
