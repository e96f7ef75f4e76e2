// One function per built-in scene, each in its own file.
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
Scene makeLens();
Scene makeGlass();
Scene makeQuay();
Scene makeStreet();

/// The number in "tessellated-N", if it is valid for makeTessellated.
std::optional<uint32_t> tessellatedTriangles(std::string_view name);
/// triangles: 100 times the square of a number from 1 to 100.
Scene makeTessellated(uint32_t triangles);

}  // namespace reflet::builtin
