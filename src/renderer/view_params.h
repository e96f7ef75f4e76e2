// Converts a scene camera to the parameters that passes use.
#pragma once

#include "effects/view.h"
#include "scene/scene.h"

namespace reflet {

/// previousWorldToClip is set to the camera's own worldToClip.
ViewParams makeViewParams(const Camera& camera, uvec2 size, uint32_t frame, uint32_t seed);

/// The parameters of another camera in the frame of `frameView`.
ViewParams makeViewParams(const Camera& camera, uvec2 size, const ViewParams& frameView);

/// The same view at another size in pixels; the aspect ratio may differ slightly.
ViewParams resized(ViewParams view, uvec2 size);

}  // namespace reflet
