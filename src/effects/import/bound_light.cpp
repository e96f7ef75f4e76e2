// Records the bounds of a host's light.
#include "effects/import/bound_light.h"

namespace reflet {

namespace {

constexpr VkFormat format = VK_FORMAT_R32_SFLOAT;
// Per frame. Highlights of the sun come and go, up to about ten times as bright as all else; history clips take what is
// left of a wrong frame.
constexpr float riseInMotion = 16.0F;
// Nothing changes at rest but what jitter shows of each pixel, so that less is enough. Means at rest never forget: a
// frame that is twice as bright is 12 % in a mean of eight, and is gone in one of fifty.
constexpr float riseAtRest = 2.0F;

}  // namespace

LightBound boundLight(gpu::PassList& f, LightBoundStore& own, uvec2 size, const LightBoundFrame& frame) {
    const uvec2 tiles = (size + boundTileSide - 1U) / boundTileSide;
    LightBound bound{.limits = f.image("light_limits", format, tiles),
                     .peaks = own.peaks.swap(f, format, tiles),
                     .exposureChange = frame.exposureChange};
    const gpu::Image framePeak = f.image("light_frame_peak", format, uvec2(1));
    f.compute("import.frame_peak", "light_frame_peak.comp")
        .read("peaks", bound.peaks.previous)
        .write("framePeak", framePeak)
        .dispatch(1);
    f.compute("import.limits", "light_limits.comp")
        .read("peaks", bound.peaks.previous)
        .read("framePeak", framePeak)
        .write("limits", bound.limits)
        .params(LightLimitsParams{tiles, frame.rests ? 0.0F : riseInMotion, frame.rests ? riseAtRest : 0.0F,
                                  frame.unbounded || !bound.peaks.valid ? 1U : 0U, frame.exposureChange})
        .dispatch(tiles);
    return bound;
}

void measureLight(gpu::PassList& f, LightBound& bound, gpu::Image light) {
    const uint32_t first = bound.peaks.valid ? lightPeaksNext : lightPeaksStart;
    const uint32_t from = bound.measured ? lightPeaksAdd : first;
    f.compute("import.peaks", "light_peaks.comp")
        .read("light", light)
        .read("previous", bound.peaks.previous)
        .write("peaks", bound.peaks.next)
        .params(LightPeakParams{light.size, from, bound.exposureChange})
        .dispatch(bound.peaks.next.size);
    bound.measured = true;
}

}  // namespace reflet
