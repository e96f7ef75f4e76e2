// Hashes of pixels (x, y, stream, frame), and the two numbers made of them.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/noise.glsl"
#include "noise_test.h"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { uvec4 items[]; } inputs;
layout(scalar) buffer OutputBlock { NoiseSample items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        uvec4 key = inputs.items[i];
        uint hash = hashPixel(key.xy, key.z, key.w);
        outputs.items[i] = NoiseSample(hash, hashToUnit(hash), hashToUnit2(hash));
    }
}
