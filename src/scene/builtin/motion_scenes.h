// Small scenes of `reflet bench --motions`: builtin:motion-NAME. They are for measurements and not in the list.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string_view>

namespace reflet::builtin {

/// "motion-room" and others; nullopt if there is none of that name.
std::optional<Scene> makeMotionScene(std::string_view name);

Scene makeMotionRoom();       ///< things all around the camera
Scene makeMotionRods();       ///< thin rods before a wall
Scene makeMotionLeaves();     ///< swinging alpha-tested leaves before a wall
Scene makeMotionMirror();     ///< a mirror that turns in the room
Scene makeMotionLamp();       ///< a lamp that moves past posts, in the dark
Scene makeMotionLampOff();    ///< a lamp that stands still, and corners that only bounced light reaches
Scene makeMotionFigures();    ///< a skinned and a morphed figure
Scene makeMotionInstances();  ///< a carousel of instances of two meshes
Scene makeMotionGlass();      ///< a sliding ball and a sliding pane of glass
Scene makeMotionBlended();    ///< a sliding alpha-blended pane and a sliding solid ball behind it

}  // namespace reflet::builtin
