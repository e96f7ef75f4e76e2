// A layer of blended surfaces as seen from the sun: the nearest ones, or (peeled) the nearest ones behind those of the
// first layer. Out: the share of the light that passes, and extinction behind it [1/m].
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(constant_id = 1) const uint usedSlots = 32767u;
#include "renderer/glass/glass_share.glsl"
#include "renderer/material.glsl"

layout(constant_id = 0) const uint peeled = 0u;
uniform sampler2D nearerDepth;

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 vertexColor;

layout(location = 0) out vec2 transmittance;

void main() {
    vec4 color;
    materialBaseColor(uv.xy, uv.zw, vertexColor, color);
    bool glass = material.glass != 0u;
    if (glass ? color.a < material.alphaCutoff : !isTranslucent(color.a)) {
        discard;
    }
    if (peeled != 0u && gl_FragCoord.z >= texelFetch(nearerDepth, ivec2(gl_FragCoord.xy), 0).r * (1.0 - peelTolerance)) {
        discard;
    }
    // Only the first layer's extinction is read, where light enters the volume.
    transmittance = vec2(glass ? glassShare(material, materialTransmission(uv.xy, uv.zw), color.rgb) : 1.0 - color.a,
                         glass ? glassExtinction(material, material.thickness) : 0.0);
}
