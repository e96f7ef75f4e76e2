// Ray slots and rays, packed and unpacked.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/rays.glsl"
#include "rays_test.h"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { RayTexel items[]; } inputs;
layout(scalar) buffer OutputBlock { RayTexel items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    RayTexel texel = inputs.items[i];
    ivec3 slot = unpackSlot(packSlot(ivec3(texel.slotX, texel.slotY, texel.slotZ)));
    Ray ray = unpackRay(packRay(Ray(texel.direction, texel.weight, texel.trust, texel.spread, texel.highlighted != 0u)));
    outputs.items[i] = RayTexel(slot.x, slot.y, slot.z, ray.direction, ray.weight, ray.trust, ray.spread, ray.highlighted ? 1u : 0u);
}
