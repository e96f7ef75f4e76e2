// The surface model: Lambert under GGX with height-correlated Smith shadowing (Heitz, Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 2014). Energy lost by single scattering is compensated
// with the directional albedo (Turquin, Practical Multiple Scattering Compensation for Microfacet Models, 2019). The
// diffuse base gets the energy that the specular layer does not reflect, so a white surface passes the furnace test at
// every roughness, metal or not. A sheen (sheen.glsl) may lie over both.
#ifndef REFLET_GGX_GLSL
#define REFLET_GGX_GLSL

#include "shaders/sampling.glsl"
#include "shaders/sheen.glsl"

// Below this perceptual roughness, the highlight of a point-like light would exceed the range of half floats.
const float minLightRoughness = 0.045;
const float dielectricF0 = 0.04;
const vec4 standardDielectric = vec4(vec3(dielectricF0), 1.0);  // F0, F90

// Normal distribution D; nh: cosine between normal and half vector.
float ggxDistribution(float nh, float alpha) {
    float a2 = alpha * alpha;
    float d = (nh * a2 - nh) * nh + 1.0;
    return a2 / (pi * d * d);
}

// V = G2 / (4 nl nv).
float ggxVisibility(float nl, float nv, float alpha) {
    float a2 = alpha * alpha;
    float v = nl * sqrt(nv * nv * (1.0 - a2) + a2);
    float l = nv * sqrt(nl * nl * (1.0 - a2) + a2);
    return 0.5 / max(v + l, 1e-7);
}

// The same for a lobe of two widths: alpha along x and y of the surface's frame, in which h, l and v are.
float ggxDistribution(vec3 h, vec2 alpha) {
    vec3 s = vec3(h.xy / alpha, h.z);
    float d = dot(s, s);
    return 1.0 / (pi * alpha.x * alpha.y * d * d);
}

float ggxVisibility(vec3 l, vec3 v, vec2 alpha) {
    float toView = l.z * length(vec3(alpha * v.xy, v.z));
    float toLight = v.z * length(vec3(alpha * l.xy, l.z));
    return 0.5 / max(toView + toLight, 1e-7);
}

// Anisotropy of a surface: the direction in which its lobe is wider, as (cos, sin) of twice its angle in basisAround the
// normal, times log2 of the factor on alpha along it over this. Across it, alpha is divided by that factor. 0: isotropic.
const float mostAnisotropy = 5.0;

vec2 anisotropicAlpha(float alpha, vec2 anisotropy) {
    float factor = exp2(mostAnisotropy * length(anisotropy));
    return alpha * vec2(factor, 1.0 / factor);
}

// The frame whose x axis is that direction.
mat3 anisotropicBasis(vec3 n, vec2 anisotropy) {
    mat3 frame = basisAround(n);
    float size = length(anisotropy);
    float twice = size > 0.0 ? anisotropy.x / size : 1.0;
    vec2 turn = sqrt(max(0.5 + vec2(0.5, -0.5) * twice, 0.0));
    turn.y = anisotropy.y < 0.0 ? -turn.y : turn.y;
    return mat3(frame[0] * turn.x + frame[1] * turn.y, frame[1] * turn.x - frame[0] * turn.y, n);
}

// Perceptual roughness of the isotropic lobe with the same mean square of widths, which has about the same albedo.
float albedoRoughness(float roughness, vec2 anisotropy) {
    vec2 factors = anisotropicAlpha(1.0, anisotropy);
    return min(roughness * sqrt(sqrt(0.5 * dot(factors, factors))), 1.0);
}

// f90: reflectance at grazing incidence.
vec3 fresnelSchlick(vec3 f0, float f90, float vh) {
    float m = clamp(1.0 - vh, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (f90 - f0) * (m2 * m2 * m);
}
vec3 fresnelSchlick(vec3 f0, float vh) { return fresnelSchlick(f0, 1.0, vh); }

// Tangent of the half angle of a cone that holds about half of the reflected light.
float ggxConeTangent(float alpha) { return 1.5 * alpha; }

// Mean direction of the light that a surface with normal +Z reflects toward v (unit, v.z > 0), weighted by the lobe
// without Fresnel. It lies between the mirror direction and the normal. Fitted to a quadrature of the lobe, within 3
// degrees. The lobe around it is about as wide as the lobe for v = +Z. Error of prefiltered radiance looked up in this
// direction, on a sphere of roughness 0.8 under a sky with a sun: relative MSE 0.015, bias +0.7 %. In the dominant
// direction of Lagarde and de Rousiers (Moving Frostbite to PBR, 2014; up to 28 degrees off): 0.019, -4 %; in the
// mirror direction: 0.062, -19 %.
vec3 ggxMeanDirection(vec3 v, float alpha) {
    float upright = alpha * alpha * (2.2 - 1.2 * alpha);
    float share = mix(upright, sqrt(alpha), pow(1.0 - v.z, max(0.32 / max(alpha, 1e-4), 1.0)));
    return normalize(mix(vec3(-v.xy, v.z), vec3(0.0, 0.0, 1.0), share));
}

// Shading parameters of one surface point, independent of the light direction.
struct Surface {
    vec3 diffuse;       // albedo of the diffuse base, times what the specular layer transmits
    vec3 f0;
    float f90;
    float roughness;    // perceptual
    vec3 compensation;  // factor on single-scattering specular
    vec3 specular;      // directional albedo toward the camera, compensated
    vec2 anisotropy;    // of the specular layer
    vec3 sheen;         // colour of the fibres over both, 0: none
    float sheenRoughness;
    vec3 sheenAlbedo;   // directional albedo toward the camera
};

// Reflects nothing.
Surface blackSurface() {
    return Surface(vec3(0.0), vec3(0.0), 0.0, 1.0, vec3(0.0), vec3(0.0), vec2(0.0), vec3(0.0), 1.0, vec3(0.0));
}

// dielectric: its F0 and F90, the reflectance of the material as far as it is not metallic. KHR_materials_specular: the
// base gets what the layer's most reflective channel leaves. table: directional albedo of the single-scattering lobe
// toward the camera as A · F0 + B · F90: texel (nv, roughness) of the image that ggx_table.comp makes. lambertOnly: no
// specular layer.
Surface makeSurface(vec3 baseColor, float metallic, float roughness, vec4 dielectric, vec2 table, bool lambertOnly) {
    Surface s = blackSurface();
    s.roughness = roughness;
    if (lambertOnly) {
        s.diffuse = baseColor;
        s.f90 = 1.0;
        return s;
    }
    s.f0 = mix(dielectric.rgb, baseColor, metallic);
    s.f90 = dielectric.a + metallic * (1.0 - dielectric.a);
    float lost = 1.0 / max(table.x + table.y, 1e-3) - 1.0;
    vec3 coat = (dielectric.rgb * table.x + dielectric.a * table.y) * (1.0 + dielectric.rgb * lost);
    vec3 metal = (baseColor * table.x + table.y) * (1.0 + baseColor * lost);
    // Interpolated by metallic, as glTF defines. The compensation is not linear in F0, so it is derived from the
    // result.
    s.specular = min(mix(coat, metal, metallic), vec3(1.0));
    s.compensation = s.specular / max(s.f0 * table.x + s.f90 * table.y, vec3(1e-4));
    s.diffuse = baseColor * ((1.0 - metallic) * (1.0 - min(max(coat.r, max(coat.g, coat.b)), 1.0)));
    return s;
}

// Fibres take what they reflect from the layers beneath. albedo: of a white sheen of that roughness toward the camera.
void addSheen(inout Surface s, vec3 color, float roughness, float albedo) {
    s.sheen = color;
    s.sheenRoughness = roughness;
    s.sheenAlbedo = color * albedo;
    float beneath = 1.0 - min(max(s.sheenAlbedo.r, max(s.sheenAlbedo.g, s.sheenAlbedo.b)), 1.0);
    s.diffuse *= beneath;
    s.specular *= beneath;
    s.compensation *= beneath;
}

// UV of an angle and a roughness in the table of directional albedos. The centres of its outer texels are 0 and 1.
const float ggxTableSize = 32.0;
vec2 ggxTableUv(float nv, float roughness) {
    return (vec2(clamp(nv, 0.0, 1.0), roughness) * (ggxTableSize - 1.0) + 0.5) / ggxTableSize;
}

// BRDF times cosine: radiance toward v for irradiance 1 on a surface that faces the light. All vectors are unit length
// and point away from the surface.
vec3 brdfTimesCosine(Surface s, vec3 n, vec3 v, vec3 l) {
    float nl = dot(n, l);
    if (nl <= 0.0) {
        return vec3(0.0);
    }
    vec3 result = s.diffuse * (nl / pi);
    float nv = max(dot(n, v), 1e-4);
    if (any(greaterThan(s.compensation, vec3(0.0)))) {
        vec3 h = normalize(v + l);
        float roughness = max(s.roughness, minLightRoughness);
        float alpha = roughness * roughness;
        float dv;
        if (s.anisotropy != vec2(0.0)) {
            mat3 frame = anisotropicBasis(n, s.anisotropy);
            vec2 widths = max(anisotropicAlpha(alpha, s.anisotropy), minLightRoughness * minLightRoughness);
            vec3 eye = v * frame;
            dv = ggxDistribution(h * frame, widths) * ggxVisibility(l * frame, vec3(eye.xy, nv), widths);
        } else {
            dv = ggxDistribution(clamp(dot(n, h), 0.0, 1.0), alpha) * ggxVisibility(nl, nv, alpha);
        }
        result += fresnelSchlick(s.f0, s.f90, dot(v, h)) * s.compensation * (dv * nl);
    }
    if (s.sheen != vec3(0.0)) {
        result += s.sheen * (sheenBrdf(nl, nv, clamp(dot(n, normalize(v + l)), 0.0, 1.0), s.sheenRoughness) * nl);
    }
    return result;
}

#endif
