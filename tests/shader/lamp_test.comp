// Irradiance from lamps at points.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/lamp.glsl"
#include "lamp_test.h"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { LampCase items[]; } inputs;
layout(scalar) buffer OutputBlock { LampLight items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        LampCase c = inputs.items[i];
        vec3 toLamp;
        vec3 irradiance = lampIrradiance(c.lamp, c.point, toLamp);
        outputs.items[i] = LampLight(irradiance, toLamp);
    }
}
