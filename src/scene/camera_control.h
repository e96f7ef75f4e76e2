// Camera movement by mouse and keyboard, independent of any window system.
#pragma once

#include "scene/scene.h"

namespace reflet {

/// Orbits the target by radians to the right and down, following the pointer. The camera never flips over.
void orbit(Camera& camera, const vec2& radians);

/// Rotates the camera in place, likewise.
void turn(Camera& camera, const vec2& radians);

/// Moves camera and target so that the target follows the pointer; right and down, in fractions of the image height.
void pan(Camera& camera, const vec2& heights);

/// Scales the distance to the target (orthographic: the visible height) by the factor.
void dolly(Camera& camera, float factor);

/// Moves camera and target: metres to the right, up, ahead.
void fly(Camera& camera, const vec3& metres);

/// A convenient flying speed for a scene of this size, in metres per second.
float flightSpeed(const Aabb& box);

}  // namespace reflet
