// The surface at a pixel of the G-buffer. Bound by bindSurfaces (gbuffer.h); uses binding 40 of set 0.
#ifndef REFLET_GBUFFER_SURFACE_GLSL
#define REFLET_GBUFFER_SURFACE_GLSL

#include "effects/gbuffer/gbuffer.glsl"
#include "effects/material_features.glsl"

uniform sampler2D surfaceReflectance;

bool isUnlit(MaterialTexel m) { return mayBeUnlit() && (m.flags & materialFlagUnlit) != 0u; }

// F0 and F90 of the dielectric.
vec4 dielectricAt(ivec2 pixel) {
    if (!mayReflectUnusually()) {
        return standardDielectric;
    }
    vec4 texel = texelFetch(surfaceReflectance, pixel, 0);
    return vec4(dielectricF0 * texel.rgb, texel.a);
}

// Its specular directional albedo is read from the table at nv. lambert: as in the material's flag, or a constant, which
// saves CPU devices from computing both branches.
Surface surfaceAt(ivec2 pixel, vec3 baseColorTexel, MaterialTexel m, float nv, sampler2D ggxTable, bool lambert) {
    if (isUnlit(m)) {
        return blackSurface();
    }
    vec2 table = lambert ? vec2(0.0) : textureLod(ggxTable, ggxTableUv(nv, m.roughness), 0.0).rg;
    return makeSurface(unpackBaseColor(baseColorTexel), m.metallic, m.roughness, dielectricAt(pixel), table, lambert);
}

// Emitted radiance. Unlit surfaces emit their base colour, which has more digits than the emissive image.
vec3 emissionAt(vec3 emissiveTexel, vec3 baseColorTexel, MaterialTexel m) {
    return isUnlit(m) ? unpackBaseColor(baseColorTexel) : emissiveTexel;
}

#endif
