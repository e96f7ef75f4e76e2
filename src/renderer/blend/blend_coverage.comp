// What the layers of blended surfaces cover. In: their light, and the share that they let through. Out: the rest.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/blend/blend.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { BlendOverParams params; };
uniform sampler2D accumulated;
layout(r32f) uniform writeonly image2D covered;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(uvec2(pixel), params.size))) {
        imageStore(covered, pixel, vec4(1.0 - texelFetch(accumulated, pixel, 0).a));
    }
}
