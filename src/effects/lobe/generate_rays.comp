// Generates the rays of a lobe: directions, weights, and the list of rays to trace.
// In: depth, both normals, material, base colour, GGX table, blue noise, tiles and the list of tiles with rays.
// Out: direction, answer and source (cleared) of the rays, the list of rays.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/rays.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 1) const uint noise = RayNoise_blue;
layout(constant_id = 2) const uint distribution = RayDistribution_cosine;
layout(constant_id = 7) const uint spreads = 0u;
layout(constant_id = 9) const uint highlights = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform RayBlock { GenerateRaysParams rayParams; };
uniform sampler2D ownDepth;
uniform usampler2D ownNormal;
uniform usampler2D ownGeometricNormal;
uniform sampler2D ownMaterial;
uniform sampler2D ownBaseColor;
uniform sampler2D ggxTable;
layout(scalar) readonly buffer BlueNoiseBlock { uint texels[]; } blueNoise;
layout(rg32f) uniform readonly image2D tiles;
layout(scalar) readonly buffer ListBlock {
    uint groups[3];
    uint count;
    uint items[];
} list;
layout(rg32ui) uniform writeonly uimage2DArray direction;
layout(rgba16f) uniform writeonly image2DArray answer;
layout(rgba8) uniform writeonly image2DArray source;
#include "effects/lobe/make_ray.glsl"
#include "effects/lobe/rays_append.glsl"

void generate(ivec2 pixel, uint rays) {
    float d = texelFetch(ownDepth, pixel, 0).r;
    MaterialTexel m = unpackMaterial(texelFetch(ownMaterial, pixel, 0));
    bool needed = d > 0.0 && (lobe == lobeDiffuse || (m.flags & materialFlagLambert) == 0u);
    vec3 n = unpackUnitVector(texelFetch(ownNormal, pixel, 0).r);
    vec3 geometric = unpackUnitVector(texelFetch(ownGeometricNormal, pixel, 0).r);
    vec3 p = uvToWorld(pixelToUv(pixel, rayParams.view.pixel), max(d, 1e-12), rayParams.view.clipToWorld);
    uint end = min(rayParams.firstRay + rayParams.rayCount, rays);
    for (uint i = rayParams.firstRay; i < end; ++i) {
        ivec3 slot = ivec3(pixel, i - rayParams.firstRay);
        imageStore(answer, slot, vec4(0.0));
        imageStore(source, slot, vec4(0.0));
        Ray ray = Ray(vec3(0.0, 0.0, 1.0), 0.0, 0.0, 0.0, false);
        if (needed) {
            ray = makeRay(RayNumber(pixel, i, rays), p, n, m, geometric);
            appendRay(WaitingRay(slot, 1.0, 0.0, false, vec3(0.0)));
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
    if (all(lessThan(pixel, ivec2(rayParams.view.size)))) {
        generate(pixel, pixelRays(imageLoad(tiles, tile).r, uvec2(pixel), rayParams.view.frame));
    }
}
