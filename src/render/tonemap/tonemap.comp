// Exposure, tone curve and display encoding. In: radiance. Out: display.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/tonemap/tonemap.h"
#include "shaders/tone_curves.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { TonemapParams params; };
layout(set = 0, binding = 1, rgba16f) uniform readonly image2D radiance;
layout(set = 0, binding = 2, rgba8) uniform writeonly image2D display;

vec3 applyCurve(vec3 c) {
    switch (params.settings.curve) {
        case ToneCurve_aces:
            return encodeSrgb(toneAces(c));
        case ToneCurve_agx:
            return encodeSrgb(toneAgx(c));
        case ToneCurve_neutral:
            return encodeSrgb(toneNeutral(c));
        case ToneCurve_gamma22:
            return pow(clamp(c, 0.0, 1.0), vec3(1.0 / 2.2));
        default:
            return encodeSrgb(c);
    }
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(uvec2(pixel), params.size))) {
        vec3 c = imageLoad(radiance, pixel).rgb * exp2(params.settings.exposure);
        imageStore(display, pixel, vec4(applyCurve(c), 1.0));
    }
}
