// The sRGB transfer function (IEC 61966-2-1). base/color.h is its twin.
// C++ too, see tone_curves.glsl.
#ifndef REFLET_SRGB_GLSL
#define REFLET_SRGB_GLSL

vec3 encodeSrgb(vec3 c) {
    c = clamp(c, 0.0f, 1.0f);
    return mix(12.92f * c, 1.055f * pow(c, vec3(1.0f / 2.4f)) - 0.055f, greaterThan(c, vec3(0.0031308f)));
}

#ifndef __cplusplus  // where nothing needs it
// Values are 0..1.
vec3 decodeSrgb(vec3 c) {
    return mix(c / 12.92f, pow((c + 0.055f) / 1.055f, vec3(2.4f)), greaterThan(c, vec3(0.04045f)));
}
#endif

#endif
