// Reads the material that a draw has bound: textures where there are any, times the factors.
// The includer defines, before it includes this: const uint usedSlots, a bit for each that any draw has a texture in. What
// is not used costs nothing; on a CPU device, what is used by one draw costs all of them.
#ifndef REFLET_MATERIAL_GLSL
#define REFLET_MATERIAL_GLSL

#include "render/material.h"

layout(set = 1, binding = 0, scalar) uniform MaterialBlock { MaterialParams material; };
layout(set = 1, binding = 1) uniform sampler2D baseColorTexture;
layout(set = 1, binding = 2) uniform sampler2D metallicRoughnessTexture;
layout(set = 1, binding = 3) uniform sampler2D normalTexture;
layout(set = 1, binding = 4) uniform sampler2D occlusionTexture;
layout(set = 1, binding = 5) uniform sampler2D emissiveTexture;

bool hasTexture(uint slot) { return (usedSlots & (1u << slot)) != 0u && (material.textured & (1u << slot)) != 0u; }

vec2 slotUv(uint slot, vec2 uv0, vec2 uv1) {
    vec3 uv = vec3((material.secondUv & (1u << slot)) != 0u ? uv1 : uv0, 1.0);
    return vec2(dot(material.uvRows[2u * slot], uv), dot(material.uvRows[2u * slot + 1u], uv));
}

// The colour with alpha, or false where the material is cut out.
bool materialBaseColor(vec2 uv0, vec2 uv1, vec4 vertexColor, out vec4 color) {
    color = material.baseColor * vertexColor;
    if (hasTexture(slotBaseColor)) {
        color *= texture(baseColorTexture, slotUv(slotBaseColor, uv0, uv1));
    }
    return color.a >= material.alphaCutoff;
}

#endif
