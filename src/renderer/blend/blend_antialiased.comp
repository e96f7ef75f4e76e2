// Composites blended surfaces over the light behind them, both antialiased. In: their radiance and what they cover; the
// light behind. Out: the sum; its alpha is that of the light behind.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/blend/blend.h"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { BlendOverParams params; };
uniform sampler2D radiance;
uniform sampler2D covered;
uniform sampler2D behind;
layout(rgba16f) uniform writeonly image2D over;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    vec4 back = texelFetch(behind, pixel, 0);
    float through = clamp(1.0 - texelFetch(covered, pixel, 0).r, 0.0, 1.0);
    vec3 sum = texelFetch(radiance, pixel, 0).rgb + through * back.rgb;
    imageStore(over, pixel, roundToHalf(vec4(clampToHalf(sum), back.a)));
}
