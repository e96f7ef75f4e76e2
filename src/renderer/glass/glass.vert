// Transmissive surfaces: clip-space positions identical to the G-buffer's.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/glass/glass.h"
#include "renderer/draw_gbuffer/exact_transform.glsl"

layout(scalar) uniform ParamsBlock { GlassDrawParams params; };
layout(push_constant, scalar) uniform DrawBlock { mat4x3 objectToWorld; } draw;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv0;
layout(location = 3) in vec2 uv1;
layout(location = 4) in vec4 color;

layout(location = 0) out vec3 normalW;
layout(location = 1) out vec4 uv;
layout(location = 2) out vec4 vertexColor;
layout(location = 3) out float scale;  // metres in the world per metre in object space
invariant gl_Position;

void main() {
    mat3 m = mat3(draw.objectToWorld);
    mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    float handedness = dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
    normalW = normalize(cofactors * normal) * handedness;
    scale = (length(m[0]) + length(m[1]) + length(m[2])) / 3.0;
    uv = vec4(uv0, uv1);
    vertexColor = color;
    vec3 positionW = exactTransform(draw.objectToWorld, position);
    gl_Position = exactTransform(params.view.worldToClip, positionW);
}
