// Motion blur in the reference: the mean over the time that the camera's shutter is open.
#pragma once

#include "reference/reference.h"

#include <functional>

namespace reflet {

/// The view at a share of the time that the shutter is open: 0 as it opens, 1 as it closes.
using ShutterViews = std::function<View(double)>;

/// As traceReference, with samples at up to 32 times, one in each of as many equal parts of the shutter's time, by
/// chance. At each the scene is posed: camera, lights, nodes, skins and morph targets move. Each has as many of
/// options.samples as the others, but for one, and at least two. Depth and normal are those of the shutter's middle.
/// options.noise: of the whole picture. Throws Error if there is not enough memory for the scene.
ReferencePicture traceShutter(const Scene& scene, const ShutterViews& at, uvec2 size, const ReferenceOptions& options,
                              const std::function<bool(const ReferenceProgress&)>& proceed = {});

}  // namespace reflet
