// What a camera's lens focuses on, as a distance along the view axis.
#pragma once

#include "scene/pose.h"

#include <string>

namespace reflet {

/// Whether `focus` has to be turned into a distance whenever the view is posed.
bool hasFocusToFind(const Camera& camera);

/// The distance in metres of the plane of focus; never nearer than the near plane. `camera` is posed, at the time of
/// `pose`. Automatic: the target of a camera that aims, else the centre of the scene's bounds, else, if that is
/// behind the camera, the target. Throws Error for a name that no instance has.
float foundFocus(const Camera& camera, const Scene& scene, const ScenePose& pose);

/// The centre of the bounds of all instances of that name. Throws Error for a name that no instance has; where: begins
/// the message.
vec3 centerOfNode(const std::string& name, const Scene& scene, const ScenePose& pose, const std::string& where);

/// Throws Error for a name that no instance has, suggesting the nearest. where: begins the message.
void checkFocus(const Camera& camera, const Scene& scene, const std::string& where);

}  // namespace reflet
