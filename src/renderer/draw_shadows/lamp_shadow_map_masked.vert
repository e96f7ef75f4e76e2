// Shadow maps of lamps, alpha-tested draws.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/draw_shadows/lamp_tile.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv0;
layout(location = 2) in vec2 uv1;
layout(location = 3) in vec4 color;

layout(location = 0) out vec4 uv;
layout(location = 1) out vec4 vertexColor;

void main() {
    placeInTile(position);
    uv = vec4(uv0, uv1);
    vertexColor = color;
}
