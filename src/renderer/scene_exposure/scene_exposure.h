// Which pictures are exposed automatically, and pictures that share the exposure of another.
#pragma once

#include "base/image_file.h"

namespace reflet {

struct Scene;
struct TonemapSettings;

/// Whether pictures of the scene are exposed automatically (tonemap.auto_exposure).
bool exposesAutomatically(const TonemapSettings& settings, const Scene& scene);

/// Settings to display other pictures of the scene with this picture's exposure: `exposure` is the sum of the automatic
/// exposure and the correction, and auto_exposure is off.
TonemapSettings exposedAs(const TonemapSettings& settings, const Scene& scene, const FloatImage& radiance,
                          const FloatImage& depth);

}  // namespace reflet
