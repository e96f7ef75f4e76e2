// Exposure, tone curve and transfer. In: radiance, exposure (a factor). Out: display, which the includer declares.
#include "effects/tonemap/display.h"
#include "effects/tonemap/display_color.glsl"

layout(constant_id = 0) const uint curve = 0u;  // constants, because CPU devices would compute all branches
layout(constant_id = 1) const uint transfer = transferSrgb;
layout(constant_id = 2) const uint hasExposure = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DisplayParams params; };
uniform sampler2D radiance;
uniform sampler2D exposure;

// Above this all curves show the brightest that they have, and their squares are finite.
const float brightest = 1e6;

// Display light, 1: white; highlights up to `most`.
vec3 brightTone(vec3 c, float most) {
    switch (curve) {
        case ToneCurve_aces:
            return toneAces(c);
        case ToneCurve_agx:
            return toneAgx(c);
        case ToneCurve_neutral:
            return clamp(toneNeutralTo(c, most), 0.0, most);
        default:
            return clamp(c, 0.0, most);
    }
}

vec3 rec2020(vec3 rec709) {
    return mat3(0.6274039, 0.0690973, 0.0163914, 0.3292830, 0.9195404, 0.0880133, 0.0433131, 0.0113623, 0.8955953) * rec709;
}

// Inverse EOTF of SMPTE ST 2084.
vec3 encodePq(vec3 nits) {
    vec3 y = pow(clamp(nits / 10000.0, 0.0, 1.0), vec3(2610.0 / 16384.0));
    return pow((3424.0 / 4096.0 + (2413.0 / 128.0) * y) / (1.0 + (2392.0 / 128.0) * y), vec3(2523.0 / 32.0));
}

vec3 encoded(vec3 c) {
    if (transfer == transferSrgb) {
        return encodedColor(c, curve);
    }
    vec3 nits = params.paperWhite * brightTone(c, params.peak);
    return transfer == transferPq ? encodePq(rec2020(nits)) : nits / 80.0;
}

float givenFactor() {
    if (hasExposure == 0u) {
        return 1.0;
    }
    float given = texelFetch(exposure, ivec2(0), 0).r;
    return given > 0.0 && !isinf(given) ? given : 1.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(uvec2(pixel), params.size))) {
        vec3 c = min(params.factor * givenFactor() * texelFetch(radiance, pixel, 0).rgb, vec3(brightest));
        imageStore(display, pixel + ivec2(params.offset), vec4(encoded(c), 1.0));
    }
}
