// Resamples what cannot be averaged: the nearest texel. In, out: R8.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/rescale/rescale.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { RescaleParams params; };
uniform sampler2D from;
layout(r8) uniform writeonly image2D to;

#include "effects/rescale/rescale.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (isInside(pixel)) {
        imageStore(to, pixel, texelFetch(from, nearestOf(pixel), 0));
    }
}
