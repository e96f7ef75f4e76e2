// Tangent frames of normals.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/sampling.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { vec3 items[]; } inputs;
layout(scalar) buffer OutputBlock { mat3 items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        outputs.items[i] = basisAround(inputs.items[i]);
    }
}
