// Tone mapping: exposure, tone curve and display encoding. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_TONEMAP_H
#define REFLET_EFFECTS_TONEMAP_H

#include "base/shared.h"

SHARED_BEGIN

#define TONE_CURVES(OPTION)       \
    OPTION(ToneCurve, gamma22, 0) \
    OPTION(ToneCurve, srgb, 1)    \
    OPTION(ToneCurve, aces, 2)    \
    OPTION(ToneCurve, agx, 3)     \
    OPTION(ToneCurve, neutral, 4)
CHOICES(ToneCurve, TONE_CURVES)

#define AUTO_EXPOSURES(OPTION)     \
    OPTION(AutoExposure, off, 0)   \
    OPTION(AutoExposure, files, 1) \
    OPTION(AutoExposure, on, 2)
CHOICES(AutoExposure, AUTO_EXPOSURES)

#define TONEMAP_SETTINGS(VALUE, SWITCH, CHOICE)                                                                        \
    VALUE(float, exposure, 0.0, -24.0, 24.0,                                                                           \
          "Exposure in stops (EV): +1 doubles the radiance before the tone curve. With auto_exposure a correction of " \
          "it.")                                                                                                       \
    CHOICE(ToneCurve, curve, neutral,                                                                                  \
           "Tone mapping curve. gamma22, srgb: clip, then 2.2 power or sRGB encoding. aces, agx, neutral (Khronos "    \
           "PBR Neutral): compress highlights.")                                                                       \
    CHOICE(AutoExposure, autoExposure, files,                                                                          \
           "Automatic exposure: surfaces are middle grey on average, by a histogram of their luminance; the "          \
           "background and the darkest and brightest pixels do not count. files: for scenes from files; lights of "    \
           "built-in scenes suit an exposure of 0. Radiance, as in EXR files, does not change.")                       \
    VALUE(float, adaptation, 0.5, 0.0, 10.0,                                                                           \
          "Automatic exposure: seconds of the scene over which it is smoothed, within the last 16 frames; 0: every "   \
          "frame has its own. More: less flicker, slower adaptation.")
SETTINGS(TonemapSettings, TONEMAP_SETTINGS)

struct TonemapParams {
    TonemapSettings settings;
    uvec2 size;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

namespace reflet {

/// RGBA8, display encoded (sRGB unless the curve is gamma22), alpha 1. `exposure`: from measureExposure; none: only the
/// settings' exposure.
gpu::Image tonemap(gpu::PassList& f, gpu::Image radiance, const TonemapSettings& settings, gpu::Image exposure = {});

}  // namespace reflet
#endif

#endif
