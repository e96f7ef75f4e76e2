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
// sheen: colour, 0..1, and perceptual roughness; anisotropy: as in Surface.
uvec2 packLayers(vec4 sheen, vec2 anisotropy) {
    return uvec2(packUnorm4x8(vec4(packBaseColor(sheen.rgb), sheen.a)), packSnorm2x16(anisotropy));
}
vec4 unpackSheen(uvec2 texel) {
    vec4 sheen = unpackUnorm4x8(texel.x);
    return vec4(unpackBaseColor(sheen.rgb), sheen.a);
}
vec2 unpackAnisotropy(uvec2 texel) { return unpackSnorm2x16(texel.y); }

bool isLambert(MaterialTexel m) { return (m.flags & materialFlagLambert) != 0u; }

#endif
