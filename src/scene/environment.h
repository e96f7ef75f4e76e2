// Environment images: what direction each texel of an equirectangular picture is seen in, and reading one.
//
// With rotation 0 the picture's centre is seen along -Z, its left half toward -X, its top row at +Y: what a camera
// that looks along -Z would see, unrolled. A rotation turns the surroundings about +Y, counter-clockwise as seen from
// above: at +90 degrees the picture's centre is at -X.
#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace reflet {

/// The largest value that an environment's image may hold, before and after its intensity [W/(m² sr)].
constexpr double largestRadiance = 1e12;

/// Where in the picture a direction is: u in [0,1) from the left, v in [0,1] from the top. `direction` of any length
/// but 0; `rotation` in radians.
vec2 environmentUv(const vec3& direction, float rotation);

/// The inverse: a unit vector.
vec3 environmentDirection(const vec2& uv, float rotation);

/// What arrives against `direction` (which points away from where it arrives, any length but 0) [W/(m² sr)]. An image
/// is constant over each of its texels: whoever draws directions by its texels then has their exact density, and the
/// texel of row r of h rows covers 2 pi / width · (cos(pi r / h) - cos(pi (r + 1) / h)) sr.
vec3 radianceFrom(const Environment& environment, const vec3& direction);

/// An .hdr file, or R, G and B of the unnamed layer of an .exr file. Throws Error: a file that cannot be read, another
/// format, channels that are missing, a value that is not finite or not within 0..largestRadiance (naming its place).
FloatImage readEnvironmentImage(const std::filesystem::path& path);

}  // namespace reflet
