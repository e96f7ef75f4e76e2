// Tone mapping: exposure, tone curve and display encoding. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_TONEMAP_H
#define REFLET_RENDER_TONEMAP_H

#include "base/shared.h"

SHARED_BEGIN

#define TONE_CURVES(OPTION)       \
    OPTION(ToneCurve, gamma22, 0) \
    OPTION(ToneCurve, srgb, 1)    \
    OPTION(ToneCurve, aces, 2)    \
    OPTION(ToneCurve, agx, 3)     \
    OPTION(ToneCurve, neutral, 4)
CHOICES(ToneCurve, TONE_CURVES)

#define TONEMAP_SETTINGS(VALUE, SWITCH, CHOICE)                                                                        \
    VALUE(float, exposure, 0.0, -24.0, 24.0, "Exposure in stops (EV): +1 doubles the radiance before the tone curve.") \
    CHOICE(ToneCurve, curve, neutral,                                                                                  \
           "Tone mapping curve. gamma22, srgb: clip, then 2.2 power or sRGB encoding. aces, agx, neutral (Khronos "    \
           "PBR Neutral): compress highlights.")
SETTINGS(TonemapSettings, TONEMAP_SETTINGS)

struct TonemapParams {
    TonemapSettings settings;
    uvec2 size;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"

namespace reflet {

/// RGBA8, display encoded (sRGB unless the curve is gamma22), alpha 1.
gpu::Image tonemap(gpu::Frame& f, gpu::Image radiance, const TonemapSettings& settings);

}  // namespace reflet
#endif

#endif
