// Reads the G-buffer back. The includer declares the samplers that the functions it calls are given.
#ifndef REFLET_GBUFFER_GLSL
#define REFLET_GBUFFER_GLSL

#include "render/gbuffer/gbuffer.h"
#include "shaders/ggx.glsl"
#include "shaders/octahedral.glsl"

struct MaterialTexel {
    float roughness;
    float metallic;
    float occlusion;
    uint flags;
};

MaterialTexel unpackMaterial(vec4 texel) {
    return MaterialTexel(texel.r, texel.g, texel.b, uint(texel.a * 255.0 + 0.5));
}

// The surface seen at a pixel, its specular directional albedo taken from the table toward nv.
Surface surfaceAt(vec3 baseColor, MaterialTexel m, float nv, sampler2D ggxTable) {
    bool lambert = (m.flags & materialFlagLambert) != 0u;
    vec2 table = lambert ? vec2(0.0) : textureLod(ggxTable, ggxTableUv(nv, m.roughness), 0.0).rg;
    return makeSurface(baseColor, m.metallic, m.roughness, table, lambert);
}

#endif
