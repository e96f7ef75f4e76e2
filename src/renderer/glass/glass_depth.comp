// Depth of whichever is nearer: the opaque surfaces or a layer of glass.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/glass/glass.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { GlassOverParams params; };
uniform sampler2D opaque;
uniform sampler2D layer;
layout(r32f) uniform writeonly image2D nearest;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(uvec2(pixel), params.size))) {
        imageStore(nearest, pixel, vec4(max(texelFetch(opaque, pixel, 0).r, texelFetch(layer, pixel, 0).r)));
    }
}
