// Tone mapping of one pixel: exposure, curve, display encoding. Compiled as GLSL by tonemap.comp,
// tonemap_auto.comp and display.glsl (the library's displays), and as C++ by tone_map_image.cpp (references and
// comparisons), so that CPU and GPU results match.
#ifndef REFLET_DISPLAY_COLOR_GLSL
#define REFLET_DISPLAY_COLOR_GLSL

#include "effects/tonemap/tonemap.h"
#include "shaders/srgb.glsl"
#include "shaders/tone_curves.glsl"

// Display encoded, 0..1. c: exposed radiance. `curve` is one of the constants ToneCurve_*.
vec3 encodedColor(vec3 c, uint curve) {
    switch (curve) {
        case ToneCurve_aces:
            return encodeSrgb(toneAces(c));
        case ToneCurve_agx:
            return encodeSrgb(toneAgx(c));
        case ToneCurve_neutral:
            return encodeSrgb(toneNeutral(c));
        case ToneCurve_gamma22:
            return pow(clamp(c, 0.0f, 1.0f), vec3(1.0f / 2.2f));
        default:
            return encodeSrgb(c);
    }
}

// exposure: stops.
vec3 displayColor(vec3 radiance, uint curve, float exposure) { return encodedColor(radiance * exp2(exposure), curve); }

#endif
