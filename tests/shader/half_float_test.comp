// Values after storage in half-float images.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/half_float.glsl"

layout(constant_id = 0) const bool rounds = false;
layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { vec3 items[]; } inputs;
layout(scalar) buffer OutputBlock { vec3 items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        vec3 v = inputs.items[i];
        outputs.items[i] = rounds ? roundToHalf(vec4(v, 0.0)).rgb : clampToHalf(v);
    }
}
