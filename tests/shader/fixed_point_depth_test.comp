// Depths quantized like fixed-point depth buffers.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/kept_depth.h"
#include "shaders/fixed_point_depth.glsl"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { KeptDepthParams params; };
layout(scalar) readonly buffer InputBlock { float items[]; } inputs;
layout(scalar) buffer OutputBlock { float items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        outputs.items[i] = fixedPointDepth(inputs.items[i], params.farDepth, params.steps);
    }
}
