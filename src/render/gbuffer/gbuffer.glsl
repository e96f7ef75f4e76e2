// Packing of the G-buffer's texels.
#ifndef REFLET_GBUFFER_GLSL
#define REFLET_GBUFFER_GLSL

#include "render/gbuffer/gbuffer.h"
#include "shaders/ggx.glsl"
#include "shaders/octahedral.glsl"

vec3 packBaseColor(vec3 linear) { return sqrt(clamp(linear, 0.0, 1.0)); }
vec3 unpackBaseColor(vec3 texel) { return texel * texel; }

struct MaterialTexel {
    float roughness;
    float metallic;
    float occlusion;
    uint flags;
};

MaterialTexel unpackMaterial(vec4 texel) {
    return MaterialTexel(texel.r, texel.g, texel.b, uint(texel.a * 255.0 + 0.5));
}
bool isLambert(MaterialTexel m) { return (m.flags & materialFlagLambert) != 0u; }

// The surface at a pixel; its specular directional albedo is read from the table at nv. lambert: as in the material's
// flag, or a constant, which saves CPU devices from computing both branches.
Surface surfaceAt(vec3 baseColorTexel, MaterialTexel m, float nv, sampler2D ggxTable, bool lambert) {
    vec2 table = lambert ? vec2(0.0) : textureLod(ggxTable, ggxTableUv(nv, m.roughness), 0.0).rg;
    return makeSurface(unpackBaseColor(baseColorTexel), m.metallic, m.roughness, table, lambert);
}

#endif
