// Directions from numbers. Which sampler: the constant.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "sampling_test.h"
#include "shaders/sampling.glsl"

layout(constant_id = 0) const uint kind = 0u;

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { SamplingParams params; };
layout(scalar) readonly buffer InputBlock { vec2 items[]; } inputs;
layout(scalar) buffer OutputBlock { vec3 items[]; } outputs;

vec3 direction(vec2 u) {
    switch (kind) {
        case samplerCosineHemisphere:
            return sampleCosineHemisphere(u);
        case samplerUniformHemisphere:
            return sampleUniformHemisphere(u);
        case samplerGgx:
            return sampleGgx(u, params.alpha);
        default:
            return sampleGgxVisible(u, params.v, params.alpha);
    }
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        outputs.items[i] = direction(inputs.items[i]);
    }
}
