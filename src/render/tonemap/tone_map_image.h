// The tone map on the CPU, for pictures that no device has rendered. The curves are the shader's own source.
#pragma once

#include "base/image_file.h"
#include "render/tonemap/tonemap.h"

namespace reflet {

/// RGB, display encoded: what the pass `tonemap` makes of the same radiance, within 1 of 255. `radiance` has 3 channels
/// [W/(m² sr)]; as in the renderer, values end at ±65504. Not a number is black.
Bitmap toneMapped(const FloatImage& radiance, const TonemapSettings& settings);

/// sRGB encoding (IEC 61966-2-1) of linear values, which are clamped to 0..1.
vec3 srgbEncoded(const vec3& linear);

}  // namespace reflet
