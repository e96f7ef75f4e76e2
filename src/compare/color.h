// The colour spaces of FLIP. Conversions start from linear sRGB (0..1, D65).
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: FLIP: A Difference Evaluator for Alternating
// Images, HPG 2020, sections 4.1.1 to 4.1.3; CIELAB: CIE 15.
#pragma once

#include "base/math.h"

namespace reflet {

/// CIE Y of a linear colour: 1 for white.
float cieLuminance(const vec3& linear);

/// YyCxCz, the opponent space of the contrast sensitivity filters: Yy -16..100 (black..white), Cx red against green, Cz
/// yellow against blue. An affine function of the linear colour.
vec3 linearToOpponent(const vec3& linear);
vec3 opponentToLinear(const vec3& opponent);

/// CIELAB with white at (100, 0, 0).
vec3 linearToLab(const vec3& linear);
/// The inverse. Colours outside sRGB's gamut have components below 0 or above 1.
vec3 labToLinear(const vec3& lab);

/// Hunt effect: colours appear less saturated when they are darker. Scales a* and b* by L* / 100.
vec3 huntAdjusted(const vec3& lab);

/// HyAB, a distance for large colour differences: |ΔL| + length of (Δa, Δb).
float hyabDistance(const vec3& labA, const vec3& labB);

}  // namespace reflet
