// Where the origin of the world is put for a scene far from the origin of its file.
#pragma once

#include "scene/scene.h"

namespace reflet {

/// In the coordinates of the scene, a point with few digits among most of its instances; 0 unless they are so far away
/// that floats would not tell their details.
glm::dvec3 nearbyOrigin(const Scene& scene);

}  // namespace reflet
