// Texel directions of cube maps, and lookups in prefiltered ones (cube_map.h): GGX-prefiltered radiance and
// irradiance.
#ifndef REFLET_CUBE_MAP_GLSL
#define REFLET_CUBE_MAP_GLSL

#include "effects/cube_map/cube_map.h"
#include "shaders/sampling.glsl"

// Direction (not unit) of a point on a face: -1 to 1 from left to right and from top to bottom.
vec3 cubeFaceDirection(vec2 at, uint face) {
    switch (face) {
        case 0u: return vec3(1.0, -at.y, -at.x);
        case 1u: return vec3(-1.0, -at.y, at.x);
        case 2u: return vec3(at.x, 1.0, at.y);
        case 3u: return vec3(at.x, -1.0, -at.y);
        case 4u: return vec3(at.x, -at.y, 1.0);
        default: return vec3(-at.x, -at.y, -1.0);
    }
}

// A texel centre's position on its face, -1 to 1.
vec2 cubeTexelCenter(ivec2 texel, int side) { return (2.0 * vec2(texel) + 1.0) / float(side) - 1.0; }

// By Gauss's quadrature of 2x2 points: off by 4e-4 of a texel for a side of 4, 3e-7 for 32. The exact difference of four
// arc tangents is worse, as Vulkan allows them an error that is near the whole solid angle of a small texel.
float cubeTexelSolidAngle(ivec2 texel, int side) {
    vec2 center = cubeTexelCenter(texel, side);
    float offset = 0.577350269 / float(side);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 at = center + offset * vec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
        float distance2 = 1.0 + dot(at, at);
        sum += inversesqrt(distance2 * distance2 * distance2);
    }
    return sum / float(side * side);
}

// Lookups. All maps need trilinear filtering; directions may have any length except for 0.

// Fractional level of a roughness. Interpolates linearly in 1 / alpha (alpha limited by the texel size), because a
// small light's mean falls quickly with roughness: halfway between roughness 0.2 and 0.4, a light of 0.1 rad is off by
// 13 % of its mean; with linear roughness it would be 49 %.
float lobeLevel(samplerCubeArray lobes, float roughness) {
    float last = float(textureQueryLevels(lobes) - 1);
    float narrower = floor(roughness * last);
    vec3 alphas = vec3(narrower / last, roughness, (narrower + 1.0) / last);
    alphas = max(alphas * alphas, vec3(0.5 * pi * 0.5 / float(textureSize(lobes, 0).x)));
    return last == 0.0 ? 0.0 : narrower + alphas.z * (alphas.y - alphas.x) / (alphas.y * max(alphas.z - alphas.x, 1e-6));
}

// Mean radiance weighted by the lobe of this perceptual roughness around the direction.
vec3 cubeMapLobe(samplerCubeArray lobes, uint cube, vec3 direction, float roughness) {
    return textureLod(lobes, vec4(direction, float(cube)), lobeLevel(lobes, roughness)).rgb;
}

// Spherical harmonics basis at a unit vector, in coefficient order.
float[irradianceCoefficients] sphericalHarmonics(vec3 n) {
    return float[irradianceCoefficients](
        0.282094792, 0.488602512 * n.y, 0.488602512 * n.z, 0.488602512 * n.x, 1.092548431 * n.x * n.y,
        1.092548431 * n.y * n.z, 0.315391565 * (3.0 * n.z * n.z - 1.0), 1.092548431 * n.x * n.z,
        0.546274215 * (n.x * n.x - n.y * n.y));
}

// Irradiance / pi for the unit normal n: the mean radiance of cosine-distributed rays. Nine coefficients ring around
// small bright lights, down to -4 % of the light's irradiance on the far side; negative values are clamped.
vec3 cubeMapIrradiance(sampler2D irradiance, uint cube, vec3 n) {
    float[irradianceCoefficients] basis = sphericalHarmonics(n);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < irradianceCoefficients; ++i) {
        sum += texelFetch(irradiance, ivec2(i, cube), 0).rgb * basis[i];
    }
    return max(sum, vec3(0.0));
}

#endif
