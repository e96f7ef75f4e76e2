// Evaluates the material bound by a draw: textures, if any, times the factors.
// The includer first defines const uint usedSlots, a bit mask of the slots for which any draw has a texture. Unused
// slots cost nothing; on CPU devices a slot used by one draw costs all draws.
#ifndef REFLET_MATERIAL_GLSL
#define REFLET_MATERIAL_GLSL

#include "effects/material_features.glsl"
#include "renderer/material.h"
#include "shaders/not_inlined.glsl"

layout(set = 1, binding = 0, scalar) uniform MaterialBlock { MaterialParams material; };
layout(set = 1, binding = 1) uniform sampler2D baseColorTexture;
layout(set = 1, binding = 2) uniform sampler2D metallicRoughnessTexture;
layout(set = 1, binding = 3) uniform sampler2D normalTexture;
layout(set = 1, binding = 4) uniform sampler2D occlusionTexture;
layout(set = 1, binding = 5) uniform sampler2D emissiveTexture;
layout(set = 1, binding = 6) uniform sampler2D specularTexture;
layout(set = 1, binding = 7) uniform sampler2D specularColorTexture;
layout(set = 1, binding = 8) uniform sampler2D transmissionTexture;
layout(set = 1, binding = 9) uniform sampler2D thicknessTexture;
layout(set = 1, binding = 10) uniform sampler2D coatTexture;
layout(set = 1, binding = 11) uniform sampler2D coatRoughnessTexture;
layout(set = 1, binding = 12) uniform sampler2D coatNormalTexture;
layout(set = 1, binding = 13) uniform sampler2D sheenColorTexture;
layout(set = 1, binding = 14) uniform sampler2D sheenRoughnessTexture;
layout(set = 1, binding = 15) uniform sampler2D anisotropyTexture;
layout(set = 1, binding = 16) uniform sampler2D iridescenceTexture;
layout(set = 1, binding = 17) uniform sampler2D iridescenceThicknessTexture;
layout(set = 1, binding = 18) uniform sampler2D diffuseTransmissionTexture;
layout(set = 1, binding = 19) uniform sampler2D diffuseTransmissionColorTexture;

bool hasTexture(uint slot) {
    return (usedSlots & (1u << slot)) != 0u && (notInlined(material.textured, gl_FragCoord) & (1u << slot)) != 0u;
}

bool isBlended() { return notInlined(material.blended, gl_FragCoord) != 0u; }

// Whether it is true for any of the four pixels that share derivatives.
bool anyInQuad(bool own) {
    float found = float(own);
    found = min(found + fwidthFine(found), 1.0);  // of neighbours in the row and the column
    return found + fwidthFine(found) > 0.0;       // and across
}

// On triangles seen edge-on, uv changes by thousands and more from pixel to pixel. Mesa's CPU driver looks up every
// texel of such a footprint in the coarsest level, which takes minutes. With any anisotropy and bias of the settings,
// footprints of more than 64 repeats are in that level, which is one texel: one of 8 repeats has the same answer.
vec2 boundedFootprint(vec2 uv) {
    vec2 reach = max(abs(dFdxFine(uv)), abs(dFdyFine(uv)));
    bool bounded = max(reach.x, reach.y) <= 64.0;  // false for NaN
    return anyInQuad(!bounded) ? fract(uv) + 8.0 * vec2(ivec2(gl_FragCoord.xy) & 1) : uv;
}

vec2 slotUv(uint slot, vec2 uv0, vec2 uv1) {
    vec3 uv = vec3((material.secondUv & (1u << slot)) != 0u ? uv1 : uv0, 1.0);
    return boundedFootprint(vec2(dot(material.uvRows[2u * slot], uv), dot(material.uvRows[2u * slot + 1u], uv)));
}

// The colour with alpha; false if alpha is below the cutoff.
bool materialBaseColor(vec2 uv0, vec2 uv1, vec4 vertexColor, out vec4 color) {
    color = material.baseColor * vertexColor;
    if (hasTexture(slotBaseColor)) {
        color *= texture(baseColorTexture, slotUv(slotBaseColor, uv0, uv1));
    }
    return color.a >= material.alphaCutoff;
}

// Whether a blended surface of this alpha is in the layers of blended surfaces.
bool isTranslucent(float alpha) { return isBlended() && alpha >= invisibleAlpha && alpha < opaqueAlpha; }

// Share of the light in the dielectric's base that passes the surface.
float materialTransmission(vec2 uv0, vec2 uv1) {
    float share = material.transmission;
    if (hasTexture(slotTransmission)) {
        share *= texture(transmissionTexture, slotUv(slotTransmission, uv0, uv1)).r;
    }
    return share;
}

// Of the dielectric: texel of the G-buffer's reflectance.
vec4 materialReflectance(vec2 uv0, vec2 uv1) {
    vec3 color = material.f0;
    float weight = material.f90;
    if (hasTexture(slotSpecular)) {
        weight *= texture(specularTexture, slotUv(slotSpecular, uv0, uv1)).a;
    }
    if (hasTexture(slotSpecularColor)) {
        color *= texture(specularColorTexture, slotUv(slotSpecularColor, uv0, uv1)).rgb;
    }
    return reflectanceTexel(color, weight);
}

// Colour and perceptual roughness of the sheen.
vec4 materialSheen(vec2 uv0, vec2 uv1) {
    vec4 sheen = vec4(material.sheenColor, material.sheenRoughness);
    if (hasTexture(slotSheenColor)) {
        sheen.rgb *= texture(sheenColorTexture, slotUv(slotSheenColor, uv0, uv1)).rgb;
    }
    if (hasTexture(slotSheenRoughness)) {
        sheen.a *= texture(sheenRoughnessTexture, slotUv(slotSheenRoughness, uv0, uv1)).a;
    }
    return sheen;
}

// The thin film: share of the surface that it covers, thickness [nm].
vec2 materialFilm(vec2 uv0, vec2 uv1) {
    vec2 film = vec2(material.film.x, material.film.w);
    if (hasTexture(slotIridescence)) {
        film.x *= texture(iridescenceTexture, slotUv(slotIridescence, uv0, uv1)).r;
    }
    if (hasTexture(slotIridescenceThickness)) {
        film.y = mix(material.film.z, material.film.w,
                     texture(iridescenceThicknessTexture, slotUv(slotIridescenceThickness, uv0, uv1)).g);
    }
    return film;
}

// Colour of the diffuse light that leaves on the other side, and its share.
vec4 materialDiffuseTransmission(vec2 uv0, vec2 uv1) {
    vec4 passes = material.diffuseTransmission;
    if (hasTexture(slotDiffuseTransmission)) {
        passes.a *= texture(diffuseTransmissionTexture, slotUv(slotDiffuseTransmission, uv0, uv1)).a;
    }
    if (hasTexture(slotDiffuseTransmissionColor)) {
        passes.rgb *= texture(diffuseTransmissionColorTexture, slotUv(slotDiffuseTransmissionColor, uv0, uv1)).rgb;
    }
    return passes;
}

// Direction of the anisotropy along tangent and bitangent, any length, and its strength.
vec3 materialAnisotropy(vec2 uv0, vec2 uv1) {
    vec3 anisotropy = vec3(material.anisotropyAlong, material.anisotropy);
    if (hasTexture(slotAnisotropy)) {
        vec3 texel = texture(anisotropyTexture, slotUv(slotAnisotropy, uv0, uv1)).rgb;
        vec2 along = texel.rg * 2.0 - 1.0;
        vec2 turn = anisotropy.xy;
        anisotropy = vec3(mat2(turn.x, turn.y, -turn.y, turn.x) * along, anisotropy.z * texel.b);
    }
    return anisotropy;
}

#endif
