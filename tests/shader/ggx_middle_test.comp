// For (nv, alpha): the reflection at the median visible normal, and the tangent of the cone's half angle.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/ggx.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { vec2 items[]; } inputs;
layout(scalar) buffer OutputBlock { vec4 items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        vec2 c = inputs.items[i];
        vec3 v = vec3(sqrt(1.0 - c.x * c.x), 0.0, c.x);
        vec3 h = sampleGgxVisible(vec2(0.0), v, c.y);
        outputs.items[i] = vec4(2.0 * dot(v, h) * h - v, ggxConeTangent(c.y));
    }
}
