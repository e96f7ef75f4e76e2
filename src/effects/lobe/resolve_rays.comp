// Averages a batch of rays per pixel. In: tiles, direction (for the weights), results, sources and steps per ray.
// Out: radiance with mean hit distance, source colours with confidence, steps, and variation of the light with the
// normal; added to earlier batches.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/rays.glsl"

layout(constant_id = 0) const uint countSteps = 0u;
layout(constant_id = 1) const uint adaptive = 0u;
layout(constant_id = 2) const uint hasDirectional = 0u;
layout(constant_id = 3) const uint adds = 0u;
layout(constant_id = 4) const uint hasTurning = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ResolveRaysParams params; };
layout(rg32ui) uniform readonly uimage2DArray direction;
layout(rgba16f) uniform readonly image2DArray answer;
layout(rgba8) uniform readonly image2DArray source;
layout(rgba16f) uniform readonly image2DArray turning;
layout(r32f) uniform readonly image2DArray steps;
layout(rg32f) uniform readonly image2D tiles;
uniform usampler2D normal;
layout(rgba16f) uniform image2D radiance;
layout(rgba16f) uniform image2D meanSource;
layout(r32f) uniform image2D meanSteps;
layout(rgba16f) uniform image2D directional;
#include "effects/lobe/resolve_ray.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    float share = imageLoad(tiles, pixel / int(rayTileSide)).r;
    uint rays = pixelRays(share, uvec2(pixel), params.frame);
    uint count = min(rays - min(params.firstRay, rays), params.rayCount);  // in this batch
    vec3 n = hasDirectional != 0u ? unpackUnitVector(texelFetch(normal, pixel, 0).r) : vec3(0.0);
    RaySum sum = noRays();
    for (uint i = 0u; i < count; ++i) {
        ivec3 slot = ivec3(pixel, i);
        AnswerSum a = AnswerSum(imageLoad(answer, slot), imageLoad(source, slot));
        addRay(sum, unpackRay(imageLoad(direction, slot).xy), a, n,
               countSteps != 0u ? imageLoad(steps, slot).r : 0.0);
        if (hasTurning != 0u && hasDirectional != 0u) {
            sum.turning += imageLoad(turning, slot);
        }
    }
    storeMean(pixel, sum, rays, share);
}
