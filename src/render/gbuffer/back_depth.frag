// Second depth layer, fragments (back faces only): what is not behind the first layer, or cut out by alpha, is peeled off.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/gbuffer/back_depth.h"
const uint usedSlots = 1u;  // the colour, for its alpha
#include "render/material.glsl"
#include "shaders/projection.glsl"

layout(set = 0, binding = 0, scalar) uniform ParamsBlock { BackDepthParams params; };
layout(set = 0, binding = 1) uniform sampler2D firstDepth;

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 vertexColor;

// How much farther than the first layer, as a part of the distance: a double-sided sheet seen from behind is no back of
// its own.
const float farther = 1e-5;

void main() {
    vec4 color;
    if (material.alphaCutoff > 0.0 && !materialBaseColor(uv.xy, uv.zw, vertexColor, color)) {
        discard;
    }
    float first = depthToViewDistance(texelFetch(firstDepth, ivec2(gl_FragCoord.xy), 0).r, params.depthToDistance);
    if (depthToViewDistance(gl_FragCoord.z, params.depthToDistance) <= first * (1.0 + farther)) {
        discard;
    }
}
