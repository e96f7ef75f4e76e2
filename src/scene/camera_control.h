// Moves a camera as hands on mouse and keys ask it to. Nothing here knows of windows.
#pragma once

#include "scene/scene.h"

namespace reflet {

/// Turns the camera round its target: radians to the right and down, as the pointer goes. It never tips over.
void orbit(Camera& camera, const vec2& radians);

/// Turns the camera where it stands, alike.
void turn(Camera& camera, const vec2& radians);

/// Moves camera and target such that what is at the target follows the pointer: shares of the picture's height, to the
/// right and down.
void pan(Camera& camera, const vec2& heights);

/// Goes nearer to the target, or away from it: factor on the distance (orthographic: on the height that is seen).
void dolly(Camera& camera, float factor);

/// Moves camera and target: metres to the right, up, ahead.
void fly(Camera& camera, const vec3& metres);

/// Looks the same way at all of the box, which is not empty. aspect: width over height of the picture.
void frameAll(Camera& camera, const Aabb& box, float aspect);

/// Metres a second at which one may want to fly through what is so large.
float flightSpeed(const Aabb& box);

}  // namespace reflet
