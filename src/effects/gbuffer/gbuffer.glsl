// Packing of the G-buffer's texels.
#ifndef REFLET_GBUFFER_GLSL
#define REFLET_GBUFFER_GLSL

#include "effects/gbuffer/gbuffer.h"
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

#endif
