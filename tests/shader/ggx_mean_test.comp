// For (nv, alpha): the mean direction of the lobe toward v.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/ggx.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { vec2 items[]; } inputs;
layout(scalar) buffer OutputBlock { vec3 items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        vec2 c = inputs.items[i];
        vec3 v = vec3(sqrt(1.0 - c.x * c.x), 0.0, c.x);
        outputs.items[i] = ggxMeanDirection(v, c.y);
    }
}
