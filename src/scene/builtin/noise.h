// Repeatable noise for the built-in scenes: an integer hash, value noise on a lattice, and sums of its octaves.
// The same number on every machine with IEEE floats; no state, no library random numbers.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace reflet::builtin {

/// A well mixed number for a lattice point.
uint32_t hash(int32_t x, int32_t y, int32_t z, uint32_t seed);

/// The same as a number in [0, 1).
float hash01(int32_t x, int32_t y, int32_t z, uint32_t seed);

/// Smooth noise in [-1, 1], features of size 1.
float noise(const vec3& p, uint32_t seed);

/// Sum of `octaves` noises, each half as large and half as strong as the one before; about [-1, 1].
float fractalNoise(const vec3& p, int octaves, uint32_t seed);

/// Noise in [-1, 1] over the unit square that continues at its edges; `cells` features a side in the first octave.
float tilingNoise(const vec2& uv, int cells, int octaves, uint32_t seed);

}  // namespace reflet::builtin
