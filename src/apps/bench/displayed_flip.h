// How different two pictures look as they are shown.
#pragma once

#include "base/image_file.h"
#include "render/tonemap/tonemap.h"

namespace reflet {

/// Mean LDR-FLIP (Andersson et al., FLIP: A Difference Evaluator for Alternating Images, 2020) of both pictures after
/// the tone map, in 8 bits. HDR-FLIP looks at every exposure, also at those that nobody sees. Throws as compareImages
/// does.
double displayedFlip(const FloatImage& picture, const FloatImage& truth, const TonemapSettings& tonemap,
                     float pixelsPerDegree);

}  // namespace reflet
