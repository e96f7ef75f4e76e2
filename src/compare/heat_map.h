// Error as colour.
#pragma once

#include "base/image_file.h"

namespace reflet {

/// RGB of the size of `error`, whose one channel holds 0 (no error, nearly black) to 1 (the largest, nearly white);
/// what lies outside counts as 0 or 1.
///
/// The colours are a curve of our own through CIELAB: for error t the lightness is L* = 4 + 92 t, the chroma
/// 66 sin(pi t), the hue 300° + 155° t, that is, from black by way of violet, red and orange to pale yellow. Lightness
/// rises evenly, so the map reads in grey and with any colour blindness, and equal steps of error are equal steps of
/// colour (CIE 1976 distance per error between 200 and 227).
Bitmap heatMap(const FloatImage& error);

}  // namespace reflet
