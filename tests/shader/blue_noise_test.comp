// Sample points for rays, with a white mask instead of a blue one: no test here depends on blue noise.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/noise.glsl"

uint loadBlueNoise(uint texel) { return hashPcg(texel); }
#include "shaders/blue_noise.glsl"
#include "blue_noise_test.h"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { BlueNoiseCase items[]; } inputs;
layout(scalar) buffer OutputBlock { BlueNoiseSample items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        BlueNoiseCase c = inputs.items[i];
        outputs.items[i] = BlueNoiseSample(blueNoiseTexel(c.pixel, c.stream), sobolPoint(c.number),
                                           blueNoisePoint(c.pixel, c.stream, c.frame, c.number, c.count));
    }
}
