// What the surfaces of a layer of glass are made of. In: the layer's depth, materials. Out: share of the light that
// passes the surface and thickness [m]; extinction [1/m] and index of refraction; the material's number.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/glass/glass.h"
layout(constant_id = 0) const uint usedSlots = 524287u;
layout(constant_id = 1) const uint fromInside = 0u;  // 1: the camera is in a medium
#include "renderer/material.glsl"
#include "shaders/half_float.glsl"

layout(scalar) uniform ParamsBlock { GlassDrawParams params; };

const float leastThickness = 1e-4;  // metres

uniform sampler2D layerDepth;

layout(location = 0) in vec3 normalW;
layout(location = 1) in vec4 uv;
layout(location = 2) in vec4 vertexColor;
layout(location = 3) in float scale;

layout(location = 0) out vec4 outTint;
layout(location = 1) out vec4 outVolume;
layout(location = 2) out uint outKind;

void main() {
    vec4 color;
    bool kept = materialBaseColor(uv.xy, uv.zw, vertexColor, color);
    float metallic = material.metallic;
    if (hasTexture(slotMetallicRoughness)) {
        metallic *= texture(metallicRoughnessTexture, slotUv(slotMetallicRoughness, uv.xy, uv.zw)).b;
    }
    float shown = texelFetch(layerDepth, ivec2(gl_FragCoord.xy), 0).r;
    kept = isBlended() ? color.a >= invisibleAlpha : kept;
    if (!kept || abs(gl_FragCoord.z - shown) > 4.0 * peelTolerance * shown) {
        discard;
    }
    float thickness = material.thickness * scale;
    if (hasTexture(slotThickness)) {
        thickness *= texture(thicknessTexture, slotUv(slotThickness, uv.xy, uv.zw)).g;
    }
    // 0 is a sheet, which a volume is nowhere.
    thickness = material.thickness > 0.0 ? clamp(thickness, leastThickness, largestHalf) : 0.0;
    if (fromInside != 0u && !gl_FrontFacing && material.glass == params.medium) {
        thickness = -thickness;
    }
    outTint = vec4(clamp(color.rgb, 0.0, 1.0) * (materialTransmission(uv.xy, uv.zw) * (1.0 - metallic)), thickness);
    outVolume = vec4(min(material.extinction, vec3(largestHalf)), material.ior);
    outKind = material.glass;
}
