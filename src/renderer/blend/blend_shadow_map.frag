// A layer of blended surfaces as seen from the sun: the nearest ones, or (peeled) the nearest ones behind those of the
// first layer. Out: the share of the light that passes; the extinction behind it [1/m].
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(constant_id = 1) const uint usedSlots = 524287u;
#include "renderer/glass/glass_share.glsl"
#include "renderer/material.glsl"

layout(constant_id = 0) const uint peeled = 0u;
uniform sampler2D nearerDepth;

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 vertexColor;

layout(location = 0) out vec4 transmittance;
layout(location = 1) out vec4 extinction;

void main() {
    vec4 color;
    materialBaseColor(uv.xy, uv.zw, vertexColor, color);
    bool glass = material.glass != 0u;
    bool covered = isBlended() ? color.a >= invisibleAlpha : color.a >= material.alphaCutoff;
    if (glass ? !covered : !isTranslucent(color.a)) {
        discard;
    }
    if (peeled != 0u && gl_FragCoord.z >= texelFetch(nearerDepth, ivec2(gl_FragCoord.xy), 0).r * (1.0 - peelTolerance)) {
        discard;
    }
    // Only the first layer's extinction is read, where light enters the volume.
    vec3 passes = glass ? glassShare(material, materialTransmission(uv.xy, uv.zw), color.rgb) : vec3(0.0);
    float coverage = isBlended() ? color.a : 1.0;
    transmittance = vec4(mix(vec3(1.0), passes, coverage), 1.0);
    extinction = vec4(glass && material.thickness > 0.0 ? material.extinction : vec3(0.0), 0.0);
}
