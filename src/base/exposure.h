// Powers of two that bring radiance of any unit close to 1, where half floats and absolute thresholds suit it.
#pragma once

#include <cmath>

namespace reflet {

/// The power of two that brings a typical radiance close to 1. Returns `now` if the radiance is 0, or if `now` brings
/// it to 2^-8 to 2^5, the range of scenes in arbitrary units, also at night. Above that range a sun seen in a mirror
/// exceeds half floats.
inline float preExposureFor(float radiance, float now = 1.0F) {
    if (!(radiance > 0.0F) || !std::isfinite(radiance)) {
        return now;
    }
    const float stops = std::log2(radiance * now);
    return stops >= -8.0F && stops <= 5.0F ? now : std::exp2(-std::round(std::log2(radiance)));
}

}  // namespace reflet
