// Generates the rays of a lobe: directions, weights, and the list of rays to trace.
// In: depth, both normals, material, base colour, GGX table, blue noise, tiles and the list of tiles with rays.
// Out: direction, answer and source (cleared) of the rays, the list of rays.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/adaptive_rays.h"
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/rays.glsl"
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "shaders/projection.glsl"
#include "shaders/sampling.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 1) const uint noise = RayNoise_blue;
layout(constant_id = 3) const uint adaptive = 0u;  // 1: rays per pixel change from frame to frame
layout(constant_id = 2) const uint distribution = RayDistribution_cosine;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { GenerateRaysParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D material;
uniform sampler2D baseColor;
uniform sampler2D ggxTable;
layout(rg32ui) uniform writeonly uimage2DArray direction;
layout(rgba16f) uniform writeonly image2DArray answer;
layout(rgba8) uniform writeonly image2DArray source;
layout(scalar) readonly buffer BlueNoiseBlock { uint texels[]; } blueNoise;
layout(rg32f) uniform readonly image2D tiles;
layout(scalar) readonly buffer ListBlock {
    uint groups[3];
    uint count;
    uint items[];
} list;
#include "effects/lobe/rays_append.glsl"

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
    uint seed = params.view.seed + lobe;
    if (noise == RayNoise_blue) {
        uint stride = adaptive != 0u ? maxAdaptiveRays : ray.count;
        return blueNoisePoint(uvec2(ray.pixel), seed, params.view.frame, ray.index, ray.count, stride);
    }
    return hashToUnit2(hashPixel(uvec2(ray.pixel), ray.index * 2u + hashPcg(seed), params.view.frame));
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
    vec3 f0 = mix(dielectric.rgb, unpackBaseColor(texelFetch(baseColor, pixel, 0).rgb), m.metallic);
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
    bool cone = m.roughness > params.specular.maxRoughness && params.specular.roughFallback == RoughFallback_mips;
    vec3 h = vec3(0.0, 0.0, 1.0);
    float share = 1.0;  // masking: the share of light along the ray that reaches the eye
    if (cone && params.coneShare == 0.0) {
        return Ray(frame * ggxMeanDirection(eye, alpha), 1.0, 1.0, m.roughness);
    }
    if (m.roughness > mirrorRoughness) {
        vec2 u = randomPair(number);
        h = sampleGgxVisible(cone ? u * vec2(params.coneShare, 1.0) : u, eye, alpha);
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
    float fade = params.specular.maxRoughness < 1.0 && params.specular.roughFallback == RoughFallback_next
                     ? smoothstep(params.specular.maxRoughness - 0.1, params.specular.maxRoughness, m.roughness)
                     : 0.0;
    return Ray(frame * l, weight, 1.0 - fade, 0.0);
}

void generate(ivec2 pixel, uint rays) {
    float d = texelFetch(depth, pixel, 0).r;
    MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
    bool needed = d > 0.0 && (lobe == lobeDiffuse || (m.flags & materialFlagLambert) == 0u);
    vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), max(d, 1e-12), params.view.clipToWorld);
    uint end = min(params.firstRay + params.rayCount, rays);
    for (uint i = params.firstRay; i < end; ++i) {
        ivec3 slot = ivec3(pixel, i - params.firstRay);
        imageStore(answer, slot, vec4(0.0));
        imageStore(source, slot, vec4(0.0));
        Ray ray = Ray(vec3(0.0, 0.0, 1.0), 0.0, 0.0, 0.0);
        if (needed) {
            RayNumber number = RayNumber(pixel, i, rays);
            ray = lobe == lobeDiffuse ? diffuseRay(number, n)
                                      : specularRay(number, n, directionToEye(p, params.view.eye), m);
            ray.direction = raiseAbove(ray.direction, unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r));
            appendRay(WaitingRay(slot, 1.0, 0.0, false));
        }
        imageStore(direction, slot, uvec4(packRay(ray), 0u, 0u));
    }
}

// One group per tile of the list.
void main() {
    uint item = gl_WorkGroupID.y * tileListRow + gl_WorkGroupID.x;
    if (item >= list.count) {
        return;
    }
    ivec2 tile = ivec2(unpackTilePlace(list.items[item]));
    ivec2 pixel = tile * int(rayTileSide) + ivec2(gl_LocalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.view.size)))) {
        generate(pixel, pixelRays(imageLoad(tiles, tile).r, uvec2(pixel), params.view.frame));
    }
}
