// Tone mapping on the CPU, for images not rendered on a device. Uses the shader's source.
#pragma once

#include "base/image_file.h"
#include "effects/tonemap/tonemap.h"

namespace reflet {

/// RGB, display encoded: the result of the pass `tonemap`, within 1 of 255. `radiance` has 3 channels [W/(m² sr)]; as
/// in the renderer, values are clamped to ±65504, before or after the exposure, whichever is more. NaN becomes black.
Bitmap toneMapped(const FloatImage& radiance, const TonemapSettings& settings);

}  // namespace reflet
