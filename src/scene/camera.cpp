// The optics of a thin lens.
#include "scene/camera.h"

#include "base/error.h"

#include <cmath>

namespace reflet {

float apertureOfFNumber(float fNumber, float fovY, float sensorHeightMillimetres) {
    REFLET_CHECK(fNumber > 0.0F && fovY > 0.0F, "f-number {}, fovY {}", fNumber, fovY);
    const float focalLength = 0.001F * sensorHeightMillimetres / (2.0F * std::tan(0.5F * fovY));
    return focalLength / (2.0F * fNumber);
}

float circleOfConfusionScale(const Camera& camera, float imageHeight) {
    if (camera.apertureRadius <= 0.0F) {
        return 0.0F;
    }
    REFLET_CHECK(camera.focusDistance > 0.0F, "focus distance {}", camera.focusDistance);
    const float slope = camera.apertureRadius / camera.focusDistance;
    return camera.orthographicHeight > 0.0F ? slope * imageHeight / camera.orthographicHeight
                                            : slope * imageHeight / (2.0F * std::tan(0.5F * camera.fovY));
}

float circleOfConfusion(const Camera& camera, float z, float imageHeight) {
    const float scale = circleOfConfusionScale(camera, imageHeight);
    if (scale == 0.0F) {
        return 0.0F;
    }
    return camera.orthographicHeight > 0.0F ? scale * (z - camera.focusDistance)
                                            : scale * (1.0F - camera.focusDistance / z);
}

}  // namespace reflet
