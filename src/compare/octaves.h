// Splits the relative MSE of an image by octave of spatial frequency: noise from pixel to pixel is in the finest
// octave, mottling in the middle ones, a wrong mean in the coarsest.
#pragma once

#include "base/image_file.h"

#include <array>
#include <cstddef>
#include <vector>

namespace reflet {

/// Wavelengths of 2 to 4, 4 to 8, 8 to 16, 16 to 32, 32 to 64 pixels, and all that are longer. The last one includes
/// the mean.
constexpr size_t octaveCount = 6;

/// The part of the relative MSE in each octave, from the finest to the coarsest.
using OctaveErrors = std::array<double, octaveCount>;

/// Added to the square of the reference: limits the relative error of dark pixels. For radiance and display values of
/// about 1.
constexpr double relativeErrorFloor = 0.01;

/// Of radiance in any unit: the same, unless the light tones are far from 1 (preExposureFor); then it changes with a
/// power of two that makes them about 1.
double relativeErrorFloorFor(std::vector<float> luminances);

/// Decomposes (a - b) / sqrt(b² + floor), the error whose mean square is the relative MSE; b is the reference. The sum
/// over octaves is the relative MSE. An octave's error is the mean square of a low-pass image less that of the next
/// lower one. The wavelength of a pattern is the shorter one of those along rows and along columns. Half of a pattern
/// at a limit is in either octave; in the middle of an octave 97 % and more are in it.
///
/// Both images must be as compareImages takes them. mask: pixels to compare; empty: all. The error of other pixels
/// counts as 0, so that the mask's outline adds to finer octaves.
OctaveErrors errorByOctave(const FloatImage& image, const FloatImage& reference, const std::vector<bool>& mask,
                           double floor = relativeErrorFloor);

}  // namespace reflet
