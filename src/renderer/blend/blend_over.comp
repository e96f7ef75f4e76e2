// Composites all layers of blended surfaces over the light behind them. In: their radiance, and the share that they let
// through; the light behind. Out: the sum, or with `coverage` what surfaces cover of the pixel; its alpha is that of the
// light behind.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/blend/blend.h"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { BlendOverParams params; };
uniform sampler2D accumulated;
uniform sampler2D behind;
layout(rgba16f) uniform writeonly image2D over;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    vec4 front = texelFetch(accumulated, pixel, 0);
    vec4 back = texelFetch(behind, pixel, 0);
    if (params.coverage != 0u) {
        front.rgb = vec3(1.0 - front.a);
    }
    imageStore(over, pixel, roundToHalf(vec4(clampToHalf(front.rgb + front.a * back.rgb), back.a)));
}
