// D, V and F of (cos nh or vh, nl, nv, alpha).
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/ggx.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { vec4 items[]; } inputs;
layout(scalar) buffer OutputBlock { vec3 items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        vec4 c = inputs.items[i];
        float fresnel = fresnelSchlick(vec3(0.04), c.x).x;
        outputs.items[i] = vec3(ggxDistribution(c.x, c.w), ggxVisibility(c.y, c.z, c.w), fresnel);
    }
}
