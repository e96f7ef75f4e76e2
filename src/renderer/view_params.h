// Converts a scene camera to the parameters that passes use.
#pragma once

#include "effects/view.h"
#include "scene/scene.h"

namespace reflet {

/// previousWorldToClip is set to the camera's own worldToClip.
ViewParams makeViewParams(const Camera& camera, uvec2 size, uint32_t frame, uint32_t seed);

/// Of another camera in the frame of `frameView`.
ViewParams makeViewParams(const Camera& camera, uvec2 size, const ViewParams& frameView);

/// The same view in another number of pixels: its sides need not have exactly the same ratio.
ViewParams resized(ViewParams view, uvec2 size);

}  // namespace reflet
