#include "measure/bench/displayed_flip.h"

#include "compare/compare.h"
#include "compare/picture_input.h"
#include "effects/exposure/exposure.h"
#include "effects/tonemap/tone_map_image.h"
#include "renderer/scene_exposure/scene_exposure.h"

namespace reflet {

double displayedFlip(const FloatImage& picture, const FloatImage& truth, const FloatImage& depth,
                     const TonemapSettings& tonemap, const Scene& scene, float pixelsPerDegree) {
    CompareOptions options;
    options.kind = ImageKind::display;
    options.pixelsPerDegree = pixelsPerDegree;
    const TonemapSettings exposed = exposedAs(tonemap, scene, truth, depth);
    return compareImages(toFloat(toneMapped(picture, exposed)), toFloat(toneMapped(truth, exposed)), options)
        .difference.flip;
}

}  // namespace reflet
