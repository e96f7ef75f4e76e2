// Cosine-distributed rays around a normal, and the light that follows for another normal.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "directional_light_test.h"
#include "shaders/directional_light.glsl"
#include "shaders/sampling.glsl"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock {
    uint side;  // its square is the number of rays
}
params;
layout(scalar) readonly buffer InputBlock {
    LitSurface items[];
}
inputs;
layout(scalar) buffer OutputBlock {
    TurnedLight items[];
}
outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    LitSurface s = inputs.items[i];
    float mean = 0.0;
    vec4 directional = vec4(0.0);
    float share = 1.0 / float(params.side * params.side);
    for (uint k = 0u; k < params.side * params.side; ++k) {
        vec2 u = (vec2(k % params.side, k / params.side) + 0.5) / float(params.side);
        vec3 direction = basisAround(s.normal) * sampleCosineHemisphere(u);
        float light = dot(direction, s.middle) >= s.leastCosine ? share : 0.0;
        mean += light;
        directional += directionalFromRay(light, direction, s.normal);
    }
    outputs.items[i] = TurnedLight(mean, relightFactor(directional, s.normal, s.turnedTo));
}
