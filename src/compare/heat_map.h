// Maps errors to colours.
#pragma once

#include "base/image_file.h"

namespace reflet {

/// An RGB image of `error`, whose single channel is 0 (no error, nearly black) to 1 (largest, nearly white); values
/// outside are clamped.
///
/// The colour map is a curve through CIELAB: for error t the lightness is L* = 4 + 92 t, the chroma 66 sin(pi t), the
/// hue 300° + 155° t, that is, from black through violet, red and orange to pale yellow. Lightness is linear, so that
/// the map is readable in greyscale and with any colour blindness, and nearly perceptually uniform (CIE 1976 distance
/// per error between 200 and 227).
Bitmap heatMap(const FloatImage& error);

}  // namespace reflet
