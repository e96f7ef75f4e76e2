// A layer of blended surfaces as seen from the sun: the nearest ones, or (peeled) the nearest ones behind those of the
// first layer. Out: the share of the light that passes.
#version 460
#extension GL_EXT_scalar_block_layout : require
const uint usedSlots = 1u;  // the colour, for its alpha
#include "renderer/material.glsl"
#include "shaders/luminance.glsl"

layout(constant_id = 0) const uint peeled = 0u;
uniform sampler2D nearerDepth;

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 vertexColor;

layout(location = 0) out float transmittance;

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
    // Of glass: what the base colour and the reflection at normal incidence leave.
    vec3 f0 = min(material.f0, vec3(25.0)) * material.f90 * 0.04;
    float passes = material.transmission * (1.0 - material.metallic) * (1.0 - min(max(f0.r, max(f0.g, f0.b)), 1.0));
    transmittance = glass ? passes * luminance(color.rgb) : 1.0 - color.a;
}
