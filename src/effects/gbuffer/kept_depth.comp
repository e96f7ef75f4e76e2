// Quantizes depth as a fixed-point depth buffer would. In: depth, reversed. Out: the same after rounding, reversed.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/kept_depth.h"
#include "shaders/fixed_point_depth.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { KeptDepthParams params; };
uniform sampler2D depth;
layout(r32f) uniform writeonly image2D kept;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.size)))) {
        float d = texelFetch(depth, pixel, 0).r;
        imageStore(kept, pixel, vec4(fixedPointDepth(d, params.farDepth, params.steps)));
    }
}
