// Sun shadow map, draws whose material is cut out by alpha: only what is there casts a shadow.
#version 460
#extension GL_EXT_scalar_block_layout : require
const uint usedSlots = 1u;  // the colour, for its alpha
#include "render/material.glsl"

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 vertexColor;

void main() {
    vec4 color;
    if (!materialBaseColor(uv.xy, uv.zw, vertexColor, color)) {
        discard;
    }
}
