// Unit vectors through 32 bits and back.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/octahedral.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { vec3 items[]; } inputs;
layout(scalar) buffer OutputBlock { vec3 items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        outputs.items[i] = unpackUnitVector(packUnitVector(inputs.items[i]));
    }
}
