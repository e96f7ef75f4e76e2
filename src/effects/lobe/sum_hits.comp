// What the rays of a pixel have hit so far, by sources that find the actual hit. In: tiles, results and sources per ray, before other
// sources answer. Out: mean over the rays of (hit distance · share of the ray, share of the ray); added to earlier batches.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/rays.glsl"

layout(constant_id = 0) const uint adds = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ResolveRaysParams params; };
layout(rgba16f) uniform readonly image2DArray answer;
layout(rgba8) uniform readonly image2DArray source;
layout(rg32f) uniform readonly image2D tiles;
layout(rg32f) uniform image2D hits;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    uint rays = pixelRays(imageLoad(tiles, pixel / int(rayTileSide)).r, uvec2(pixel), params.frame);
    uint count = min(rays - min(params.firstRay, rays), params.rayCount);  // in this batch
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < count; ++i) {
        sum += vec2(imageLoad(answer, ivec3(pixel, i)).a, imageLoad(source, ivec3(pixel, i)).a);
    }
    sum /= float(max(rays, 1u));
    imageStore(hits, pixel, vec4(adds != 0u ? imageLoad(hits, pixel).rg + sum : sum, 0.0, 0.0));
}
