// Second depth layer (back faces only), by depth peeling: discards fragments not behind the first layer and those that
// fail the alpha test.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/draw_gbuffer/back_depth.h"
const uint usedSlots = 1u;  // base colour, for alpha
#include "renderer/material.glsl"
#include "shaders/projection.glsl"

layout(scalar) uniform ParamsBlock { BackDepthParams params; };
uniform sampler2D firstDepth;

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 vertexColor;

// Relative distance by which the second layer must be behind the first, so that the back of a double-sided sheet does
// not count as its own far side.
const float farther = 1e-5;

void main() {
    vec4 color;
    bool cutOut = notInlined(uint(material.alphaCutoff > 0.0), gl_FragCoord) != 0u;
    if (cutOut && !materialBaseColor(uv.xy, uv.zw, vertexColor, color)) {
        discard;
    }
    float first = depthToViewDistance(texelFetch(firstDepth, ivec2(gl_FragCoord.xy), 0).r, params.depthToDistance);
    if (depthToViewDistance(gl_FragCoord.z, params.depthToDistance) <= first * (1.0 + farther)) {
        discard;
    }
}
