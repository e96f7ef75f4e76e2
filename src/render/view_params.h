// From a scene's camera to what passes know of it.
#pragma once

#include "render/view.h"
#include "scene/scene.h"

namespace reflet {

/// The camera as passes see it. previousWorldToClip is set to the camera's own.
ViewParams makeViewParams(const Camera& camera, uvec2 size, uint32_t frame, uint32_t seed);

}  // namespace reflet
