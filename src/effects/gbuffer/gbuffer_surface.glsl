// The surface at a pixel of the G-buffer. Bound by bindSurfaces (gbuffer.h); uses binding 40 of set 0.
#ifndef REFLET_GBUFFER_SURFACE_GLSL
#define REFLET_GBUFFER_SURFACE_GLSL

#include "effects/gbuffer/gbuffer.glsl"
#include "effects/material_features.glsl"

uniform sampler2D surfaceReflectance;
uniform usampler2D surfaceLayers;

bool isUnlit(MaterialTexel m) { return mayBeUnlit() && (m.flags & materialFlagUnlit) != 0u; }

// F0 and F90 of the dielectric.
vec4 dielectricAt(ivec2 pixel) {
    if (!mayReflectUnusually()) {
        return standardDielectric;
    }
    vec4 texel = texelFetch(surfaceReflectance, pixel, 0);
    return vec4(dielectricF0 * texel.rgb, texel.a);
}

vec2 anisotropyAt(ivec2 pixel) {
    return mayBeAnisotropic() ? unpackAnisotropy(texelFetch(surfaceLayers, pixel, 0).rg) : vec2(0.0);
}

// Its specular directional albedo is read from the table at nv. lambert: as in the material's flag, or a constant, which
// saves CPU devices from computing both branches.
Surface surfaceAt(ivec2 pixel, vec3 baseColorTexel, MaterialTexel m, float nv, sampler2D ggxTable, bool lambert) {
    if (isUnlit(m)) {
        return blackSurface();
    }
    vec2 anisotropy = lambert ? vec2(0.0) : anisotropyAt(pixel);
    float tableRoughness = mayBeAnisotropic() ? albedoRoughness(m.roughness, anisotropy) : m.roughness;
    vec2 table = lambert ? vec2(0.0) : textureLod(ggxTable, ggxTableUv(nv, tableRoughness), 0.0).rg;
    Surface s = makeSurface(unpackBaseColor(baseColorTexel), m.metallic, m.roughness, dielectricAt(pixel), table, lambert);
    s.anisotropy = anisotropy;
    if (mayHaveSheen() && !lambert) {
        vec4 sheen = unpackSheen(texelFetch(surfaceLayers, pixel, 0).rg);
        addSheen(s, sheen.rgb, sheen.a, textureLod(ggxTable, ggxTableUv(nv, sheen.a), 0.0).b);
    }
    return s;
}

// Emitted radiance, pre-exposed. Unlit surfaces emit their base colour, which has more digits than the emissive image.
vec3 emissionAt(vec3 emissiveTexel, vec3 baseColorTexel, MaterialTexel m, float preExposure) {
    return isUnlit(m) ? preExposure * unpackBaseColor(baseColorTexel) : emissiveTexel;
}

#endif
