// Averages a batch of rays per pixel. In: tiles, direction (for the weights), results, sources and steps per ray.
// Out: radiance with mean hit distance, source colours with confidence, steps, and variation of the light with the
// normal; added to earlier batches.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/rays.glsl"
#include "shaders/directional_light.glsl"
#include "shaders/luminance.glsl"

layout(constant_id = 0) const uint countSteps = 0u;
layout(constant_id = 1) const uint adaptive = 0u;
layout(constant_id = 2) const uint hasDirectional = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ResolveRaysParams params; };
layout(rg32ui) uniform readonly uimage2DArray direction;
layout(rgba16f) uniform readonly image2DArray answer;
layout(rgba8) uniform readonly image2DArray raySource;
layout(rgba16f) uniform image2D radiance;
layout(rgba16f) uniform image2D source;
layout(r32f) uniform readonly image2DArray raySteps;
layout(r32f) uniform image2D steps;
layout(rg32f) uniform readonly image2D tiles;
uniform usampler2D normal;
layout(rgba16f) uniform image2D directional;

void resolveSteps(ivec2 pixel, uint count, float weight) {
    float sum = 0.0;
    for (uint i = 0u; i < count; ++i) {
        sum += imageLoad(raySteps, ivec3(pixel, i)).r;
    }
    sum *= weight;
    if (params.firstRay > 0u) {
        sum += imageLoad(steps, pixel).r;
    }
    imageStore(steps, pixel, vec4(sum));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    float share = imageLoad(tiles, pixel / int(rayTileSide)).r;
    uint rays = pixelRays(share, uvec2(pixel), params.frame);
    uint count = min(rays - min(params.firstRay, rays), params.rayCount);  // in this batch
    float weight = 1.0 / float(max(rays, 1u));
    vec4 light = vec4(0.0);
    vec4 colors = vec4(0.0);
    vec4 turning = vec4(0.0);
    vec3 n = hasDirectional != 0u ? unpackUnitVector(texelFetch(normal, pixel, 0).r) : vec3(0.0);
    for (uint i = 0u; i < count; ++i) {
        ivec3 slot = ivec3(pixel, i);
        Ray ray = unpackRay(imageLoad(direction, slot).xy);
        vec4 a = imageLoad(answer, slot);
        light += vec4(a.rgb * ray.weight, a.a);
        if (hasDirectional != 0u) {
            float bright = luminance(clampToHalf(a.rgb * ray.weight));
            turning += ray.spread > 0.0 ? directionalFromAmbient(bright) : directionalFromRay(bright, ray.direction, n);
        }
        colors += imageLoad(raySource, slot);
    }
    light *= weight;
    colors *= weight;
    turning *= weight;
    if (params.firstRay > 0u) {
        light += imageLoad(radiance, pixel);
        colors += imageLoad(source, pixel);
        turning += hasDirectional != 0u ? imageLoad(directional, pixel) : vec4(0.0);
    }
    if (adaptive != 0u && rays == 0u && share > 0.0) {
        light.a = -1.0;  // no rays in this frame
    }
    imageStore(radiance, pixel, roundToHalf(vec4(clampToHalf(light.rgb), min(light.a, largestHalf))));
    imageStore(source, pixel, roundToHalf(colors));
    if (hasDirectional != 0u) {
        imageStore(directional, pixel, roundToHalf(clamp(turning, -largestHalf, largestHalf)));
    }
    if (countSteps != 0u) {
        resolveSteps(pixel, count, weight);
    }
}
