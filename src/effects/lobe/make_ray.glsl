// Directions and weights of the rays of a lobe. The includer declares rayParams (GenerateRaysParams), the image
// ownBaseColor, ggxTable, the buffer blueNoise and the constants lobe, noise, distribution, adaptive and
// spreads.
#ifndef REFLET_MAKE_RAY_GLSL
#define REFLET_MAKE_RAY_GLSL

#include "effects/gbuffer/gbuffer_surface.glsl"
#include "effects/lobe/adaptive_rays.h"
#include "effects/lobe/rays.glsl"
#include "shaders/projection.glsl"
#include "shaders/sampling.glsl"

uint loadBlueNoise(uint texel) { return blueNoise.texels[texel]; }
#include "shaders/blue_noise.glsl"

const float lowestRay = 1e-3;  // smallest sine of the angle between a ray and its surface

// The index of a ray among a pixel's rays.
struct RayNumber {
    ivec2 pixel;
    uint index;
    uint count;
};

// Two random numbers in [0, 1) for a ray.
vec2 randomPair(RayNumber ray) {
    uint seed = rayParams.view.seed + lobe;
    if (noise == RayNoise_blue) {
        uint stride = adaptive != 0u ? maxAdaptiveRays : ray.count;
        return blueNoisePoint(uvec2(ray.pixel), seed, rayParams.view.frame, ray.index, ray.count, stride);
    }
    return hashToUnit2(hashPixel(uvec2(ray.pixel), ray.index * 2u + hashPcg(seed), rayParams.view.frame));
}

Ray diffuseRay(RayNumber number, vec3 n) {
    vec2 u = randomPair(number);
    if (distribution == RayDistribution_uniform) {
        vec3 local = sampleUniformHemisphere(u);
        return Ray(basisAround(n) * local, 2.0 * local.z, 1.0, 0.0);  // cos / pi over 1 / (2 pi)
    }
    if (distribution == RayDistribution_normal) {
        return Ray(n, 1.0, 0.0, 1.0);
    }
    return Ray(basisAround(n) * sampleCosineHemisphere(u), 1.0, 1.0, 0.0);
}

// Normal maps and smooth normals send some rays below the surface; these are bent to just above it.
vec3 raiseAbove(vec3 direction, vec3 geometric) {
    float height = dot(direction, geometric);
    return height < lowestRay ? normalize(direction + geometric * (lowestRay - height)) : direction;
}

// F0 by its luminance over F90, by which the weight of a ray does not change; of a surface that reflects nothing: any.
float relativeF0(ivec2 pixel, MaterialTexel m) {
    vec4 dielectric = dielectricAt(pixel);
    vec3 f0 = mix(dielectric.rgb, unpackBaseColor(texelFetch(ownBaseColor, pixel, 0).rgb), m.metallic);
    float f90 = dielectric.a + m.metallic * (1.0 - dielectric.a);
    return f90 > 0.0 ? dot(f0, vec3(0.2126, 0.7152, 0.0722)) / f90 : dielectricF0;
}

// Reflection at a sampled visible GGX normal. The weight is BRDF · cos / pdf divided by the directional albedo, which
// the composite multiplies in. One weight for all three channels: F0 is taken by its luminance.
Ray specularRay(RayNumber number, vec3 n, vec3 v, MaterialTexel m) {
    mat3 frame = basisAround(n);
    vec3 eye = v * frame;
    eye = normalize(vec3(eye.xy, max(eye.z, 1e-3)));  // normal maps may face away from the eye
    float alpha = m.roughness * m.roughness;
    bool cone = spreads != 0u && m.roughness > rayParams.specular.maxRoughness && rayParams.specular.roughFallback == RoughFallback_mips;
    vec3 h = vec3(0.0, 0.0, 1.0);
    float share = 1.0;  // masking: the share of light along the ray that reaches the eye
    if (cone && rayParams.coneShare == 0.0) {
        return Ray(frame * ggxMeanDirection(eye, alpha), 1.0, 1.0, m.roughness);
    }
    if (m.roughness > mirrorRoughness) {
        vec2 u = randomPair(number);
        h = sampleGgxVisible(cone ? u * vec2(rayParams.coneShare, 1.0) : u, eye, alpha);
    }
    vec3 l = 2.0 * dot(eye, h) * h - eye;
    if (cone) {
        return Ray(frame * l, 1.0, 1.0, m.roughness);
    }
    if (m.roughness > mirrorRoughness) {
        float a2 = alpha * alpha;
        share = ggxVisibility(max(l.z, 0.0), eye.z, alpha) * 2.0 * max(l.z, 0.0) *
                (eye.z + sqrt(eye.z * eye.z * (1.0 - a2) + a2));
    }
    float y = relativeF0(number.pixel, m);
    vec2 table = textureLod(ggxTable, ggxTableUv(eye.z, m.roughness), 0.0).rg;
    float weight = share * fresnelSchlick(vec3(y), dot(eye, h)).x / max(y * table.x + table.y, 1e-3);
    float fade = rayParams.specular.maxRoughness < 1.0 && rayParams.specular.roughFallback == RoughFallback_next
                     ? smoothstep(rayParams.specular.maxRoughness - 0.1, rayParams.specular.maxRoughness, m.roughness)
                     : 0.0;
    return Ray(frame * l, weight, 1.0 - fade, 0.0);
}

// The ray of a surface with this point, shading normal, material and geometric normal.
Ray makeRay(RayNumber number, vec3 p, vec3 n, MaterialTexel m, vec3 geometric) {
    Ray ray = lobe == lobeDiffuse ? diffuseRay(number, n)
                                  : specularRay(number, n, directionToEye(p, rayParams.view.eye), m);
    ray.direction = raiseAbove(ray.direction, geometric);
    return ray;
}

#endif
