// Motion blur in the reference: the mean over the time that the camera's shutter is open.
#pragma once

#include "reference/reference.h"

#include <functional>

namespace reflet {

/// The view at a share of the time that the shutter is open: 0 as it opens, 1 as it closes.
using ShutterViews = std::function<View(double)>;

/// As traceReference, with stratified sampling of up to 32 times: one random time in each of as many equal parts of the
/// shutter interval. For each time the scene is posed: camera, lights, nodes, skins and morph targets move.
/// options.samples is distributed evenly over the times (±1), at least two for each. Depth and normal are those at the
/// middle of the interval. options.noise: of the whole picture. Throws Error if there is not enough memory for the
/// scene.
ReferencePicture traceShutter(const Scene& scene, const ShutterViews& at, uvec2 size, const ReferenceOptions& options,
                              const std::function<bool(const ReferenceProgress&)>& proceed = {});

}  // namespace reflet
