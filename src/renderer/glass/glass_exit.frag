// The nearest back faces behind a layer of glass, of the same material at each pixel. In: the layer's depth and
// materials. Out: depth, outward normal.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/glass/glass.h"
const uint usedSlots = 1u;  // base colour, for alpha
#include "renderer/material.glsl"
#include "shaders/octahedral.glsl"

uniform sampler2D layerDepth;
uniform usampler2D kind;

layout(location = 0) in vec3 normalW;
layout(location = 1) in vec4 uv;
layout(location = 2) in vec4 vertexColor;
layout(location = 3) in float scale;

layout(location = 0) out uint outNormal;

void main() {
    vec4 color;
    bool kept = materialBaseColor(uv.xy, uv.zw, vertexColor, color);
    kept = isBlended() ? color.a >= invisibleAlpha : kept;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool same = texelFetch(kind, pixel, 0).r == material.glass;
    if (!kept || !same || gl_FragCoord.z >= texelFetch(layerDepth, pixel, 0).r * (1.0 - peelTolerance)) {
        discard;
    }
    outNormal = packUnitVector(normalize(normalW));
}
