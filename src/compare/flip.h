// FLIP: per-pixel difference that a person perceives when alternating between two images.
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: FLIP: A Difference Evaluator for Alternating
// Images, HPG 2020 (with its erratum: Yy is normalized by 116).
// Andersson, Nilsson, Shirley, Akenine-Möller: Visualizing Errors in Rendered High Dynamic Range Images, Eurographics
// 2021 short papers.
#pragma once

#include "base/math.h"
#include "compare/filter.h"

namespace reflet {

/// LDR-FLIP of two images of the same size: linear sRGB in 0..1. Each pixel is 0 (identical) to 1. Symmetric.
Plane ldrFlip(const Planes3& linearA, const Planes3& linearB, float pixelsPerDegree);

/// The evenly spaced exposures, in stops, of HDR-FLIP.
struct ExposureRange {
    double start = 0.0;
    double stop = 0.0;
    uint32_t count = 1;

    [[nodiscard]] double at(uint32_t index) const;
};

/// From the exposure that maps the reference's largest luminance to 0.85 on the display to the one that maps its median
/// there; as many as there are stops in between, at least both ends. Not specified in the paper: if the median is 0,
/// the median of the values above 0 is used; a black reference has the single exposure 0.
ExposureRange exposureRange(const Planes3& reference);

/// Tone mapping of scene radiance (>= 0) to 0..1: the paper's default, an approximation of ACES (Narkowicz: ACES Filmic
/// Tone Mapping Curve, 2015).
float displayTone(float radiance);

/// HDR-FLIP: the largest LDR-FLIP over all exposures of exposureRange(reference). Values below 0 count as 0.
Plane hdrFlip(const Planes3& image, const Planes3& reference, float pixelsPerDegree);

/// FLIP's feature pipeline: difference of edges and points, 0..1, in two images of Yy in 0..1.
Plane featureDifference(const Plane& a, const Plane& b, float pixelsPerDegree);

}  // namespace reflet
