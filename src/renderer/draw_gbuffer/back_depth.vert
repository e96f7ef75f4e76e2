// Second depth layer: clip-space positions identical to the G-buffer's.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/draw_gbuffer/back_depth.h"
#include "renderer/draw_gbuffer/exact_transform.glsl"

layout(scalar) uniform ParamsBlock { BackDepthParams params; };
layout(push_constant, scalar) uniform DrawBlock { mat4x3 objectToWorld; } draw;

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv0;
layout(location = 2) in vec2 uv1;
layout(location = 3) in vec4 color;

layout(location = 0) out vec4 uv;
layout(location = 1) out vec4 vertexColor;
invariant gl_Position;

void main() {
    vec3 positionW = exactTransform(draw.objectToWorld, position);
    gl_Position = exactTransform(params.worldToClip, positionW);
    uv = vec4(uv0, uv1);
    vertexColor = color;
}
