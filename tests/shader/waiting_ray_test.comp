// What is left of waiting rays and how far they were free, packed and unpacked.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/bounce/rays.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer InputBlock { vec2 items[]; } inputs;
layout(set = 0, binding = 1, scalar) buffer OutputBlock { vec2 items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        WaitingRay ray = unpackWaitingRay(packWaitingRay(WaitingRay(ivec3(0), inputs.items[i].x, inputs.items[i].y)));
        outputs.items[i] = vec2(ray.rest, ray.clear);
    }
}
