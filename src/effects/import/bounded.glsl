// Radiance of at most a luminance, of the same hue, in half floats.
#ifndef REFLET_BOUNDED_GLSL
#define REFLET_BOUNDED_GLSL

#include "effects/import/bound_light.h"
#include "shaders/half_float.glsl"
#include "shaders/luminance.glsl"

// radiance: finite.
vec3 boundedLuminance(vec3 radiance, float most) {
    vec3 positive = max(radiance, vec3(0.0));
    return clampToHalf(positive * min(1.0, most / max(luminance(positive), 1e-12)));
}

#endif
