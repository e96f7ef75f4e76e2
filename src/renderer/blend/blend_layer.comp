// Composites a layer of blended surfaces under those in front of it, or those of its surfaces that are on one side of the
// nearest glass. In: the layer's radiance, its alpha (in the image of its motion), its depth; depth of the glass. In and out: radiance of the layers so far, and the share of the light behind that they let through.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/blend/blend.h"
#include "shaders/half_float.glsl"

layout(constant_id = 0) const uint side = 0u;  // 1: before the glass; 2: behind it

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { BlendLayerParams params; };
uniform sampler2D radiance;
uniform sampler2D motion;
uniform sampler2D depth;
uniform sampler2D glassDepth;
layout(rgba16f) uniform image2D accumulated;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    vec4 front = params.first != 0u ? vec4(0.0, 0.0, 0.0, 1.0) : imageLoad(accumulated, pixel);
    float alpha = texelFetch(motion, pixel, 0).a;
    if (side != 0u) {
        bool before = texelFetch(depth, pixel, 0).r > texelFetch(glassDepth, pixel, 0).r;
        alpha = before == (side == 1u) ? alpha : 0.0;
    }
    vec3 light = front.rgb + front.a * alpha * texelFetch(radiance, pixel, 0).rgb;
    imageStore(accumulated, pixel, roundToHalf(vec4(clampToHalf(light), front.a * (1.0 - alpha))));
}
