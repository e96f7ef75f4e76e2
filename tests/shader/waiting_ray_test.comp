// Waiting rays, packed and unpacked.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/rays.glsl"
#include "rays_test.h"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { WaitingItem items[]; } inputs;
layout(scalar) buffer OutputBlock { WaitingItem items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        WaitingItem given = inputs.items[i];
        WaitingRay ray = WaitingRay(ivec3(0), given.rest, given.clear, given.lost != 0u, vec3(1.0));
        ray = unpackWaitingRay(packWaitingRay(ray));
        outputs.items[i] = WaitingItem(ray.rest, ray.clear, ray.lost ? 1u : 0u);
    }
}
