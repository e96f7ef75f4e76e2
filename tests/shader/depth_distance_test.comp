// View distances of depths.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/view.h"
#include "shaders/projection.glsl"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { ViewParams params; };
layout(scalar) readonly buffer InputBlock { float items[]; } inputs;
layout(scalar) buffer OutputBlock { float items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        outputs.items[i] = depthToViewDistance(inputs.items[i], params.depthToDistance);
    }
}
