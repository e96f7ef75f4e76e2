// FLIP: the difference that a person sees who flips between two pictures, for every pixel.
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: FLIP: A Difference Evaluator for Alternating
// Images, HPG 2020 (with its erratum: Yy is normalized by 116).
// Andersson, Nilsson, Shirley, Akenine-Möller: Visualizing Errors in Rendered High Dynamic Range Images, Eurographics
// 2021 short papers.
#pragma once

#include "base/math.h"
#include "compare/filter.h"

namespace reflet {

/// LDR-FLIP of two pictures of one size: linear sRGB in 0..1. Each pixel is 0 (the same) to 1. Symmetric.
Plane flipOfDisplay(const Planes3& linearA, const Planes3& linearB, float pixelsPerDegree);

/// The exposures in stops, evenly apart, at which HDR-FLIP looks at two pictures.
struct ExposureRange {
    double start = 0.0;
    double stop = 0.0;
    uint32_t count = 1;

    [[nodiscard]] double at(uint32_t index) const;
};

/// From the exposure that brings the truth's largest luminance to 0.85 on the display to the one that brings its median
/// there; as many as there are stops in between, at least both ends. What the paper leaves open: where the median is 0,
/// it is the median of what is above 0; a black truth has the one exposure 0.
ExposureRange exposureRange(const Planes3& truth);

/// 0..1 on the display for scene radiance from 0 up: the paper's standard curve, an approximation of ACES (Narkowicz:
/// ACES Filmic Tone Mapping Curve, 2015).
float displayTone(float radiance);

/// HDR-FLIP: the largest FLIP over all exposures of exposureRange(truth). What is below 0 counts as 0.
Plane flipOfRadiance(const Planes3& picture, const Planes3& truth, float pixelsPerDegree);

/// How differently edges and points show in two images of Yy in 0..1, 0..1; the second half of FLIP.
Plane featureDifference(const Plane& a, const Plane& b, float pixelsPerDegree);

}  // namespace reflet
