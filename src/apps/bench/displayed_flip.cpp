#include "apps/bench/displayed_flip.h"

#include "apps/picture_input.h"
#include "compare/compare.h"
#include "render/tonemap/tone_map_image.h"

namespace reflet {

double displayedFlip(const FloatImage& picture, const FloatImage& truth, const TonemapSettings& tonemap,
                     float pixelsPerDegree) {
    CompareOptions options;
    options.kind = ImageKind::display;
    options.pixelsPerDegree = pixelsPerDegree;
    return compareImages(toFloat(toneMapped(picture, tonemap)), toFloat(toneMapped(truth, tonemap)), options)
        .difference.flip;
}

}  // namespace reflet
