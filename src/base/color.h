// Luminance, and the sRGB transfer function; shaders/srgb.glsl is its twin. Linear colours have sRGB (Rec. 709)
// primaries.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <cmath>
#include <concepts>

namespace reflet {

/// Relative luminance, Rec. 709.
inline float luminance(const vec3& linear) {
    return glm::dot(linear, vec3(0.2126F, 0.7152F, 0.0722F));
}

/// Linear value of an sRGB-encoded channel (IEC 61966-2-1). Values outside of 0..1 are clamped.
template <std::floating_point T>
T decodeSrgb(T encoded) {
    const T c = std::clamp(encoded, T(0), T(1));
    return c <= T(0.04045) ? c / T(12.92) : std::pow((c + T(0.055)) / T(1.055), T(2.4));
}

/// The inverse of decodeSrgb.
template <std::floating_point T>
T encodeSrgb(T linear) {
    const T c = std::clamp(linear, T(0), T(1));
    return c <= T(0.0031308) ? T(12.92) * c : T(1.055) * std::pow(c, T(1) / T(2.4)) - T(0.055);
}

}  // namespace reflet
