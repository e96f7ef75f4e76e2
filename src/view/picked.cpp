// Brings records of a frame to pixels of the picture.
#include "view/picked.h"

#include <utility>

namespace reflet {

void takeRay(Picked& picked, const RecordedRay& ray, const PixelScale& scale) {
    picked.ray = ray;
    picked.ray->pixel = scale.toPicture(ray.pixel);
    picked.cells.clear();
    for (const RayStep& step : ray.steps) {
        const auto side = static_cast<float>(1U << step.level);
        picked.cells.push_back(
            {scale.placeInPicture(vec2(step.cell) * side), scale.placeInPicture(vec2(side)), step.level == 0});
    }
}

void takeHemisphere(Picked& picked, std::vector<RecordedSample> samples, const PixelScale& scale) {
    picked.hemisphere = std::move(samples);
    for (RecordedSample& sample : picked.hemisphere) {
        sample.pixel = scale.toPicture(sample.pixel);
    }
}

}  // namespace reflet
