// Colours through the curve of the constant: 0 encodeSrgb, 1 ACES, 2 AgX, 3 neutral.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/srgb.glsl"
#include "shaders/tone_curves.glsl"

layout(constant_id = 0) const uint curve = 0u;

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { vec3 items[]; } inputs;
layout(scalar) buffer OutputBlock { vec3 items[]; } outputs;

vec3 applied(vec3 c) {
    switch (curve) {
        case 0u:
            return encodeSrgb(c);
        case 1u:
            return toneAces(c);
        case 2u:
            return toneAgx(c);
        default:
            return toneNeutral(c);
    }
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        outputs.items[i] = applied(inputs.items[i]);
    }
}
