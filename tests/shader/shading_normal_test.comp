// Bends shading normals.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/shading_normal.glsl"
#include "shading_normal_test.h"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock {
    NormalCase items[];
}
inputs;
layout(scalar) buffer OutputBlock {
    vec3 items[];
}
outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        NormalCase c = inputs.items[i];
        outputs.items[i] = consistentNormal(c.normal, c.geometric, c.toViewer);
    }
}
