// Equirectangular environment images: mapping between directions and texels, radiance lookup, and reading from files.
//
// With rotation 0 the image's centre is at -Z, its left half toward -X and its top row at +Y, as a camera that looks
// along -Z would see it, unrolled. A rotation turns the environment about +Y, counter-clockwise as seen from above: at
// +90 degrees the image's centre is at -X.
#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace reflet {

/// The largest value that an environment's image may hold, before and after its intensity [W/(m² sr)].
constexpr double largestRadiance = 1e12;

/// Image coordinates of a direction: u in [0,1) from the left, v in [0,1] from the top. `direction` may have any length
/// but 0; `rotation` is in radians.
vec2 environmentUv(const vec3& direction, float rotation);

/// The inverse: a unit vector.
vec3 environmentDirection(const vec2& uv, float rotation);

/// Radiance that arrives from `direction` (pointing toward the environment, any length but 0) [W/(m² sr)]. An image is
/// constant over each texel, so that importance sampling by texels has an exact pdf; a texel of row r of h rows covers
/// 2 pi / width · (cos(pi r / h) - cos(pi (r + 1) / h)) sr.
vec3 radianceFrom(const Environment& environment, const vec3& direction);

/// Reads an .hdr file, or R, G and B of the unnamed layer of an .exr file. Throws Error for an unreadable file, another
/// format, a missing channel, or a value that is not finite or not within 0..largestRadiance (naming the texel).
FloatImage readEnvironmentImage(const std::filesystem::path& path);

}  // namespace reflet
