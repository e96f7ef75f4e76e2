// Directions and weights of the rays of a lobe. The includer declares what diffuse_ray.glsl requires, the image
// ownBaseColor, ggxTable and the constants spreads and highlights.
#ifndef REFLET_MAKE_RAY_GLSL
#define REFLET_MAKE_RAY_GLSL

#include "effects/gbuffer/gbuffer_surface.glsl"
#include "effects/lobe/diffuse_ray.glsl"
#include "effects/lobe/rays.glsl"
#include "shaders/emitter_highlight.glsl"
#include "shaders/projection.glsl"
#include "shaders/sampling.glsl"

// F0 by its luminance over F90, by which the weight of a ray does not change; of a surface that reflects nothing: any.
float relativeF0(ivec2 pixel, MaterialTexel m) {
    vec4 dielectric = dielectricAt(pixel);
    vec3 f0 = mix(dielectric.rgb, unpackBaseColor(texelFetch(ownBaseColor, pixel, 0).rgb), m.metallic);
    float f90 = dielectric.a + m.metallic * (1.0 - dielectric.a);
    return f90 > 0.0 ? dot(f0, vec3(0.2126, 0.7152, 0.0722)) / f90 : dielectricF0;
}

// Share of the light along l that reaches the eye from a normal that is visible to it: the rest is masked.
float unmaskedShare(vec3 l, vec3 eye, float alpha, vec2 widths) {
    vec3 toLight = vec3(l.xy, max(l.z, 0.0));
    if (mayBeAnisotropic()) {
        return ggxVisibility(toLight, eye, widths) * 2.0 * toLight.z * (eye.z + length(vec3(widths * eye.xy, eye.z)));
    }
    float a2 = alpha * alpha;
    return ggxVisibility(toLight.z, eye.z, alpha) * 2.0 * toLight.z * (eye.z + sqrt(eye.z * eye.z * (1.0 - a2) + a2));
}

// Samples a reflection by the lobe with its masking: visible normals are drawn until masking lets one pass. All such rays
// have the same share, the mean one. Shares of single visible normals are anything from 0 to a multiple of their mean on rough
// surfaces, noise that would be there even where the same light comes from all directions. The last try always passes: about
// 1 % of the rays of a surface of roughness 1 seen from above, fewer on smoother ones.
const uint lobeTries = 8u;
vec3 sampleUnmasked(RayNumber number, vec3 eye, float alpha, vec2 widths) {
    vec2 u = randomPair(number);
    uint stream = number.index * 2u + 1u + hashPcg(rayParams.view.seed + 5u);
    uint random = hashPixel(uvec2(number.pixel), stream, rayParams.view.frame);
    for (uint i = 1u;; ++i) {
        vec3 h = sampleGgxVisible(u, eye, widths);
        float share = unmaskedShare(2.0 * dot(eye, h) * h - eye, eye, alpha, widths);
        random = hashPcg(random);
        if (i == lobeTries || hashToUnit(random) < share) {
            return h;
        }
        random = hashPcg(random);
        u = hashToUnit2(random);
    }
}

// Reflection at a sampled visible GGX normal. The weight is BRDF · cos / pdf divided by the directional albedo, which
// the composite multiplies in. One weight for all three channels: F0 is taken by its luminance.
Ray specularRay(RayNumber number, vec3 n, vec3 v, MaterialTexel m) {
    vec2 anisotropy = anisotropyAt(number.pixel);
    mat3 frame = mayBeAnisotropic() ? anisotropicBasis(n, anisotropy) : basisAround(n);
    vec3 eye = v * frame;
    eye = normalize(vec3(eye.xy, max(eye.z, 1e-3)));  // normal maps may face away from the eye
    float alpha = m.roughness * m.roughness;
    vec2 widths = mayBeAnisotropic() ? anisotropicAlpha(alpha, anisotropy) : vec2(alpha);
    bool cone = spreads != 0u && m.roughness > rayParams.specular.maxRoughness &&
                rayParams.specular.roughFallback == RoughFallback_mips && anisotropy == vec2(0.0);
    if (cone && rayParams.coneShare == 0.0) {
        return Ray(frame * ggxMeanDirection(eye, alpha), 1.0, 1.0, m.roughness, false);
    }
    float tableRoughness = mayBeAnisotropic() ? albedoRoughness(m.roughness, anisotropy) : m.roughness;
    vec2 table = textureLod(ggxTable, ggxTableUv(eye.z, tableRoughness), 0.0).rg;
    vec3 h = vec3(0.0, 0.0, 1.0);
    float share = 1.0;
    if (cone && m.roughness > mirrorRoughness) {
        h = sampleGgxVisible(randomPair(number) * vec2(rayParams.coneShare, 1.0), eye, widths);
    } else if (m.roughness > mirrorRoughness) {
        h = sampleUnmasked(number, eye, alpha, widths);
        share = table.x + table.y;
    }
    vec3 l = 2.0 * dot(eye, h) * h - eye;
    if (cone) {
        return Ray(frame * l, 1.0, 1.0, m.roughness, false);
    }
    float y = relativeF0(number.pixel, m);
    float weight = share * fresnelSchlick(vec3(y), dot(eye, h)).x / max(y * table.x + table.y, 1e-3);
    float fade = rayParams.specular.maxRoughness < 1.0 && rayParams.specular.roughFallback == RoughFallback_next
                     ? smoothstep(rayParams.specular.maxRoughness - 0.1, rayParams.specular.maxRoughness, m.roughness)
                     : 0.0;
    uint stream = number.index * 2u + hashPcg(rayParams.view.seed + 9u);
    float chance = hashToUnit(hashPixel(uvec2(number.pixel), stream, rayParams.view.frame));
    bool highlighted = highlights != 0u && chance < highlightShare(m.roughness, rayParams.roughestHighlight);
    return Ray(frame * l, weight, 1.0 - fade, 0.0, highlighted);
}

// The ray of a surface with this point, shading normal, material and geometric normal.
Ray makeRay(RayNumber number, vec3 p, vec3 n, MaterialTexel m, vec3 geometric) {
    Ray ray = lobe == lobeDiffuse ? diffuseRay(number, n)
                                  : specularRay(number, n, directionToEye(p, rayParams.view.eye), m);
    ray.direction = raiseAbove(ray.direction, geometric);
    return ray;
}

#endif
