// Sun shadow map, draws whose material is cut out by alpha: only what is there casts a shadow.
#version 460
#extension GL_EXT_scalar_block_layout : require
const uint usedSlots = 1u;  // the colour, for its alpha
#include "renderer/material.glsl"

layout(constant_id = 0) const uint opaqueOnly = 0u;  // 1: of blended surfaces only what is opaque

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 vertexColor;

void main() {
    vec4 color;
    bool kept = materialBaseColor(uv.xy, uv.zw, vertexColor, color);
    if (opaqueOnly != 0u && isBlended()) {
        kept = color.a >= opaqueAlpha;
    }
    if (!kept) {
        discard;
    }
}
