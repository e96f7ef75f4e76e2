// The visible difference of two images as displayed.
#pragma once

#include "base/image_file.h"
#include "effects/tonemap/tonemap.h"
#include "scene/scene.h"

namespace reflet {

/// Mean LDR-FLIP (Andersson et al., FLIP: A Difference Evaluator for Alternating Images, 2020) of both images after
/// tone mapping to 8 bits. HDR-FLIP, in contrast, takes all exposures into account, also those that are not displayed.
/// Both are displayed with the same exposure; an automatic one (`tonemap` of a scene) is metered from the ground truth
/// where `depth` has a surface. Throws as compareImages does.
double displayedFlip(const FloatImage& picture, const FloatImage& truth, const FloatImage& depth,
                     const TonemapSettings& tonemap, const Scene& scene, float pixelsPerDegree);

}  // namespace reflet
