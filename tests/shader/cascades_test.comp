// selectCascade for each distance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/cascades.glsl"
#include "cascades_test.h"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { SunShadowParams params; };
layout(scalar) readonly buffer InputBlock { float items[]; } inputs;
layout(scalar) buffer OutputBlock { CascadeAnswer items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        Cascade c = selectCascade(inputs.items[i], params);
        outputs.items[i] = CascadeAnswer(c.index, c.next);
    }
}
