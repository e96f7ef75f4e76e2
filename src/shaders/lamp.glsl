// Irradiance from the lamps of KHR_lights_punctual.
#ifndef REFLET_LAMP_GLSL
#define REFLET_LAMP_GLSL

#include "effects/lamps.h"

// Irradiance on a surface at p that faces the lamp. toLamp: unit, from p.
vec3 lampIrradiance(LampParams lamp, vec3 p, out vec3 toLamp) {
    if (lamp.type == lampDirectional) {
        toLamp = lamp.toLamp;
        return lamp.intensity;
    }
    vec3 d = lamp.position - p;
    float square = max(dot(d, d), 1e-8);
    toLamp = d * inversesqrt(square);
    float reach = square * lamp.inverseRange * lamp.inverseRange;
    float window = clamp(1.0 - reach * reach, 0.0, 1.0);
    float factor = window / square;
    if (lamp.type == lampSpot) {
        float cone = clamp(dot(toLamp, lamp.toLamp) * lamp.spotScale + lamp.spotOffset, 0.0, 1.0);
        factor *= cone * cone;
    }
    return lamp.intensity * factor;
}

#endif
