// G-buffer: evaluates the material's textures and factors, and the shading normal. The includer defines
// REFLET_REFLECTANCE_TARGET and REFLET_LAYERS_TARGET if there are targets for the reflectance, and for sheen and
// anisotropy: a shader must not write to one that is missing.
#include "effects/gbuffer/gbuffer.glsl"
#include "renderer/draw_gbuffer/draw_gbuffer.h"
#include "shaders/shading_normal.glsl"
#include "shaders/thin_film.glsl"

layout(constant_id = 0) const uint clipped = 0u;
layout(constant_id = 2) const uint usedSlots = 524287u;
layout(constant_id = 3) const uint surfaces = surfacesOpaque;
layout(constant_id = 4) const uint translucent = translucentBlended;
const bool drawsCoats = translucent >= translucentCoat && translucent <= translucentBlendedCoat;
const bool drawsOtherSide = translucent == translucentOtherSide;
#include "renderer/material.glsl"

layout(scalar) uniform ParamsBlock { GBufferParams params; };
uniform sampler2D opaqueDepth;
uniform sampler2D nearerDepth;

layout(location = 0) in vec3 normalW;
layout(location = 1) in vec4 tangentW;
layout(location = 2) in vec4 uv;
layout(location = 3) in vec4 vertexColor;
layout(location = 4) in vec3 clipNow;
layout(location = 5) in vec4 clipBefore;
layout(location = 6) in vec3 fromEye;

layout(location = 0) out vec4 outBaseColor;
layout(location = 1) out uint outNormal;
layout(location = 2) out uint outGeometricNormal;
layout(location = 3) out vec4 outMaterial;
layout(location = 4) out vec3 outEmissive;
layout(location = 5) out vec4 outMotion;
#ifdef REFLET_REFLECTANCE_TARGET
layout(location = 6) out vec4 outReflectance;
#endif
#ifdef REFLET_LAYERS_TARGET
layout(location = 7) out uvec2 outLayers;
#endif

vec3 towardEye() { return params.view.eye.w > 0.0 ? -fromEye : params.view.eye.xyz; }

// The triangle's normal, facing the camera; the shading normal if the triangle is seen edge-on.
vec3 geometricNormal(vec3 shading) {
    vec3 n = cross(dFdx(fromEye), dFdy(fromEye));
    float square = dot(n, n);
    if (!(square > 1e-30)) {
        return shading;
    }
    return n * (inversesqrt(square) * (dot(n, towardEye()) < 0.0 ? -1.0 : 1.0));
}

mat3 tangentFrame(vec3 n) {
    vec3 t = normalize(tangentW.xyz - n * dot(n, tangentW.xyz));
    return mat3(t, cross(n, t) * tangentW.w, n);
}

vec3 mappedNormal(vec3 n, vec3 texel, float scale) {
    vec3 m = texel * 2.0 - 1.0;
    m.xy *= scale;
    return normalize(tangentFrame(n) * m);
}

#ifdef REFLET_LAYERS_TARGET
// KHR_materials_anisotropy: alpha grows from `roughness` squared toward 1 along the direction. Sets the roughness to that
// of the geometric mean of both. n: as packed in the G-buffer.
vec2 anisotropyAround(vec3 n, inout float roughness) {
    const float leastAlpha = 1e-3;
    vec3 anisotropy = materialAnisotropy(uv.xy, uv.zw);
    mat3 frame = tangentFrame(gl_FrontFacing ? n : -n);
    vec3 direction = frame[0] * anisotropy.x + frame[1] * anisotropy.y;
    mat3 basis = basisAround(n);
    vec2 along = vec2(dot(direction, basis[0]), dot(direction, basis[1]));
    float square = dot(along, along);
    if (!(anisotropy.z > 0.0) || !(square > 1e-6)) {
        return vec2(0.0);
    }
    float across = max(roughness * roughness, leastAlpha);
    float ratio = mix(across, 1.0, anisotropy.z * anisotropy.z) / across;
    roughness = sqrt(across * sqrt(ratio));
    vec2 twice = vec2(along.x * along.x - along.y * along.y, 2.0 * along.x * along.y) / square;
    return twice * (0.5 * log2(ratio) / mostAnisotropy);
}
#endif

vec3 shadingNormal() {
    vec3 n = normalize(normalW);
    if (drawsCoats) {
        if (hasTexture(slotCoatNormal)) {
            n = mappedNormal(n, texture(coatNormalTexture, slotUv(slotCoatNormal, uv.xy, uv.zw)).xyz,
                             material.coatNormalScale);
        }
    } else if (hasTexture(slotNormal)) {
        n = mappedNormal(n, texture(normalTexture, slotUv(slotNormal, uv.xy, uv.zw)).xyz, material.normalScale);
    }
    return gl_FrontFacing ? n : -n;
}

#ifdef REFLET_REFLECTANCE_TARGET
// KHR_materials_iridescence: colours the reflectance at normal incidence, of dielectrics in the texel of the reflectance
// and of metals in their base colour, so that the reflectance is the film's at the angle of view.
void addFilm(float cosine, float metallic, inout vec4 reflectance, inout vec3 baseColor) {
    vec2 film = materialFilm(uv.xy, uv.zw);
    vec3 f0 = reflectance.rgb * dielectricF0;
    reflectance.rgb = mix(f0, filmF0At(cosine, material.film.y, film.y, f0), film.x) / dielectricF0;
    baseColor = mix(baseColor, filmF0At(cosine, material.film.y, film.y, baseColor), film.x * metallic);
}
#endif

// Share of the surface that is coated, and the coat's roughness.
vec2 clearCoat() {
    vec2 coat = vec2(material.coat, material.coatRoughness);
    if (hasTexture(slotCoat)) {
        coat.x *= texture(coatTexture, slotUv(slotCoat, uv.xy, uv.zw)).r;
    }
    if (hasTexture(slotCoatRoughness)) {
        coat.y *= texture(coatRoughnessTexture, slotUv(slotCoatRoughness, uv.xy, uv.zw)).g;
    }
    return coat;
}

// Whether a translucent surface is in the layer, by its depth.
bool isPeeled() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool seen = gl_FragCoord.z >= texelFetch(opaqueDepth, pixel, 0).r * (1.0 - peelTolerance);
    if (surfaces == surfacesBehind) {
        seen = seen && gl_FragCoord.z < texelFetch(nearerDepth, pixel, 0).r * (1.0 - peelTolerance);
    }
    return seen;
}

// kept: by the alpha test.
bool isDrawn(float alpha, bool kept) {
    bool opaque = isBlended() ? alpha >= params.blendedFrom : kept;
    if (surfaces == surfacesOpaque) {
        return opaque;
    }
    bool glass = translucent == translucentGlass || translucent == translucentGlassCoat;
    bool glassKept = isBlended() ? alpha >= invisibleAlpha : kept;
    bool ofOpaque = translucent == translucentCoat || drawsOtherSide;
    return isPeeled() && (glass ? glassKept : ofOpaque ? opaque : isTranslucent(alpha));
}

vec2 roughnessAndMetallic() {
    vec2 factors = vec2(material.roughness, material.metallic);
    if (hasTexture(slotMetallicRoughness)) {
        factors *= texture(metallicRoughnessTexture, slotUv(slotMetallicRoughness, uv.xy, uv.zw)).gb;
    }
    return factors;
}

float occlusionOfMap() {
    if (!hasTexture(slotOcclusion)) {
        return 1.0;
    }
    float o = texture(occlusionTexture, slotUv(slotOcclusion, uv.xy, uv.zw)).r;
    return 1.0 + material.occlusionStrength * (o - 1.0);
}

// Pre-exposed.
vec3 emittedRadiance() {
    vec3 radiance = material.emissive * mix(params.view.preExposure, 1.0, material.preExposed);
    if (hasTexture(slotEmissive)) {
        radiance *= texture(emissiveTexture, slotUv(slotEmissive, uv.xy, uv.zw)).rgb;
    }
    return radiance;
}

// Alpha of the motion's image: coverage of glass, which a mask leaves whole; what glass leaves of its diffuse base.
vec4 baseOfGlass(vec4 baseColor) {
    float passes = materialTransmission(uv.xy, uv.zw) * (1.0 - material.metallic);  // metals stay as they are
    return vec4(baseColor.rgb * (1.0 - passes), isBlended() ? baseColor.a : 1.0);
}

// Of diffuse light.
float shareOfOtherSide() {
    bool any = notInlined(uint(material.diffuseTransmission.a > 0.0), gl_FragCoord) != 0u;
    return any && params.settings.lambertOnly == 0u ? materialDiffuseTransmission(uv.xy, uv.zw).a : 0.0;
}

void main() {
    vec3 n = shadingNormal();
    vec3 geometric = geometricNormal(n);  // derivatives must be taken before any discard
    n = consistentNormal(n, geometric, normalize(towardEye()));
    vec3 positionW = fromEye + params.view.eye.xyz * params.view.eye.w;
    if (clipped != 0u && dot(params.clipPlane, vec4(positionW, 1.0)) <= 0.0) {
        discard;
    }
    vec4 baseColor;
    bool kept = materialBaseColor(uv.xy, uv.zw, vertexColor, baseColor);
    if (!isDrawn(baseColor.a, kept)) {
        discard;
    }
    if (translucent == translucentGlass) {
        baseColor = baseOfGlass(baseColor);
    }
    vec2 roughnessMetallic = roughnessAndMetallic();
    uint flags = params.settings.lambertOnly != 0u ? materialFlagLambert : 0u;
    flags |= material.emitter != 0u ? materialFlagEmitter : 0u;
    bool unlit = mayBeUnlit() && notInlined(material.unlit, gl_FragCoord) != 0u;
    bool bare = unlit || drawsCoats || drawsOtherSide;  // neither emits nor has an occlusion map
    float occlusion = bare ? 1.0 : occlusionOfMap();
    outEmissive = bare ? vec3(0.0) : emittedRadiance();
    if (unlit) {
        flags |= materialFlagUnlit;
        roughnessMetallic = vec2(1.0, 0.0);
    }
    if (drawsCoats) {
        vec2 coat = clearCoat();
        float covered = translucent == translucentGlassCoat && isBlended() ? baseColor.a : 1.0;
        baseColor = vec4(vec3(0.0), coat.x * covered);
        roughnessMetallic = vec2(coat.y, 0.0);
    }
#ifdef REFLET_REFLECTANCE_TARGET
    outReflectance = materialReflectance(uv.xy, uv.zw);
    if (!drawsCoats && !drawsOtherSide && notInlined(uint(material.film.x > 0.0), gl_FragCoord) != 0u) {
        addFilm(max(dot(n, normalize(towardEye())), 0.0), roughnessMetallic.y, outReflectance, baseColor.rgb);
    }
#endif
    if (drawsOtherSide) {
        vec4 passes = materialDiffuseTransmission(uv.xy, uv.zw);
        baseColor.rgb = passes.rgb * (passes.a * (1.0 - roughnessMetallic.y));
        n = -n;
        geometric = -geometric;
        roughnessMetallic = vec2(1.0, 0.0);
        flags = materialFlagLambert;
    } else {
        baseColor.rgb *= 1.0 - shareOfOtherSide() * (1.0 - roughnessMetallic.y);
    }
#ifdef REFLET_LAYERS_TARGET
    vec2 anisotropy = anisotropyAround(unpackUnitVector(packUnitVector(n)), roughnessMetallic.x);
    outLayers = packLayers(materialSheen(uv.xy, uv.zw), anisotropy);
#endif
    outBaseColor = vec4(packBaseColor(baseColor.rgb), 1.0);
    outNormal = packUnitVector(n);
    outGeometricNormal = packUnitVector(geometric);
    outMaterial = vec4(roughnessMetallic, occlusion, float(flags) / 255.0);
    // Not fused: exactly 0 at rest.
    precise vec2 moved = clipNow.xy / clipNow.z - clipBefore.xy / clipBefore.z;
    outMotion = vec4(0.5 * moved, clipBefore.w, surfaces == surfacesOpaque ? 0.0 : baseColor.a);
}
