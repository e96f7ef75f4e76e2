// Subpixel jitter offsets and jittered views.
#include "effects/jitter.h"

#include <cmath>

namespace reflet {

vec2 subpixelJitter(uint32_t index) {
    constexpr double step[] = {0.7548776662466927, 0.5698402909980532};
    const auto at = [&](double s) { return static_cast<float>(std::fmod(0.5 + index * s, 1.0) - 0.5); };
    return {at(step[0]), at(step[1])};
}

void applyJitter(ViewParams& view, const vec2& jitter, const vec2& previousJitter) {
    const vec2 shift = -2.0F * jitter * view.pixel;  // in clip space, where w is 1
    mat4 move(1.0F);
    move[3] = vec4(shift, 0.0F, 1.0F);
    mat4 back(1.0F);
    back[3] = vec4(-shift, 0.0F, 1.0F);
    mat4 widen(1.0F);  // by half a pixel to each side, the largest jitter
    widen[0][0] += view.pixel.x;
    widen[1][1] += view.pixel.y;
    view.paddedClipToWorld = view.clipToWorld * widen;
    view.worldToClip = move * view.worldToClip;
    view.previousWorldToClip = move * view.previousWorldToClip;
    view.clipToWorld = view.clipToWorld * back;
    view.jitterChange = (jitter - previousJitter) * view.pixel;
}

}  // namespace reflet
