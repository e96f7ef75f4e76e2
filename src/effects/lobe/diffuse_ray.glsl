// Directions and weights of diffuse rays. The includer declares rayParams (GenerateRaysParams), the buffer blueNoise and the
// constants lobe, noise and distribution.
#ifndef REFLET_DIFFUSE_RAY_GLSL
#define REFLET_DIFFUSE_RAY_GLSL

#include "effects/lobe/rays.glsl"
#include "shaders/noise.glsl"
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
        return blueNoisePoint(uvec2(ray.pixel), seed, rayParams.view.frame, ray.index, ray.count);
    }
    return hashToUnit2(hashPixel(uvec2(ray.pixel), ray.index * 2u + hashPcg(seed), rayParams.view.frame));
}

Ray diffuseRay(RayNumber number, vec3 n) {
    vec2 u = randomPair(number);
    if (distribution == RayDistribution_uniform) {
        vec3 local = sampleUniformHemisphere(u);
        return Ray(basisAround(n) * local, 2.0 * local.z, 1.0, 0.0, false);  // cos / pi over 1 / (2 pi)
    }
    if (distribution == RayDistribution_normal) {
        return Ray(n, 1.0, 0.0, 1.0, false);
    }
    return Ray(basisAround(n) * sampleCosineHemisphere(u), 1.0, 1.0, 0.0, false);
}

// Normal maps and smooth normals send some rays below the surface; these are bent to just above it.
vec3 raiseAbove(vec3 direction, vec3 geometric) {
    float height = dot(direction, geometric);
    return height < lowestRay ? normalize(direction + geometric * (lowestRay - height)) : direction;
}

#endif
