// Colour helpers: luminance and sRGB decoding. Linear colours have sRGB (Rec. 709) primaries.
#pragma once

#include "base/math.h"

#include <cmath>

namespace reflet {

/// Relative luminance, Rec. 709.
inline float luminance(const vec3& linear) {
    return glm::dot(linear, vec3(0.2126F, 0.7152F, 0.0722F));
}

/// Linear 0..1 from an sRGB-encoded channel 0..1. (IEC 61966-2-1)
inline double decodeSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace reflet
