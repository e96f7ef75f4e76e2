// Adds the light that surfaces transmit diffusely. In: depth of these surfaces, their light, all other light. Out: the sum,
// with the alpha of the other light.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/other_side/other_side.h"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { OtherSideParams params; };
uniform sampler2D depth;
uniform sampler2D layer;
uniform sampler2D light;
layout(rgba16f) uniform writeonly image2D sum;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    vec4 all = texelFetch(light, pixel, 0);
    if (texelFetch(depth, pixel, 0).r > 0.0) {
        all.rgb += texelFetch(layer, pixel, 0).rgb;
    }
    imageStore(sum, pixel, roundToHalf(vec4(clampToHalf(all.rgb), all.a)));
}
