// Composites a layer of blended surfaces under those in front of it. In: the layer's radiance, its alpha (in the image
// of its motion). In and out: radiance of the layers so far, and the share of the light behind that they let through.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/blend/blend.h"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { BlendLayerParams params; };
uniform sampler2D radiance;
uniform sampler2D motion;
layout(rgba16f) uniform image2D accumulated;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    vec4 front = params.first != 0u ? vec4(0.0, 0.0, 0.0, 1.0) : imageLoad(accumulated, pixel);
    float alpha = texelFetch(motion, pixel, 0).a;
    vec3 light = front.rgb + front.a * alpha * texelFetch(radiance, pixel, 0).rgb;
    imageStore(accumulated, pixel, roundToHalf(vec4(clampToHalf(light), front.a * (1.0 - alpha))));
}
