// The built-in scenes, one function and one file each.
#pragma once

#include "scene/scene.h"

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

}  // namespace reflet::builtin
