// Powers of two that bring radiance of any unit close to 1, where half floats and absolute thresholds suit it.
#pragma once

#include <cmath>

namespace reflet {

/// The power of two that brings a typical radiance close to 1. It is `now` if the radiance is 0, and as long as that
/// brings it to 2^-8 to 2^5, as it does for scenes that people light by eye, also at night. Above, a sun that is seen
/// in a mirror is beyond half floats.
inline float preExposureFor(float radiance, float now = 1.0F) {
    if (!(radiance > 0.0F) || !std::isfinite(radiance)) {
        return now;
    }
    const float stops = std::log2(radiance * now);
    return stops >= -8.0F && stops <= 5.0F ? now : std::exp2(-std::round(std::log2(radiance)));
}

}  // namespace reflet
