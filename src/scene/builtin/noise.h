// Deterministic noise for the built-in scenes: an integer hash, value noise on a lattice, and sums of octaves.
// Stateless, and identical on every machine with IEEE floats.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet::builtin {

/// Hash of a lattice point.
uint32_t hash(int32_t x, int32_t y, int32_t z, uint32_t seed);

/// The same, mapped to [0, 1).
float hash01(int32_t x, int32_t y, int32_t z, uint32_t seed);

/// Smooth noise in [-1, 1], features of size 1.
float noise(const vec3& p, uint32_t seed);

/// Sum of `octaves` noises, each with half the size and strength of the previous one; about [-1, 1].
float fractalNoise(const vec3& p, int octaves, uint32_t seed);

/// Tileable noise in [-1, 1] over the unit square; the first octave has `cells` features per side.
float tilingNoise(const vec2& uv, int cells, int octaves, uint32_t seed);

}  // namespace reflet::builtin
