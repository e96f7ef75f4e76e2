// Numbers of given hashes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/noise.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { uint items[]; } inputs;
layout(scalar) buffer OutputBlock { float items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        outputs.items[i] = hashToUnit(inputs.items[i]);
    }
}
