// Adds the diffuse light that rays of visible surfaces have found in this frame to the cells of these surfaces.
// In: surfaces; light, not denoised. Out: samples in the cache. A thread per square of pixels.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/radiance_cache/radiance_cache.glsl"
#include "shaders/half_float.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { FeedCacheParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
layout(rgba16f) uniform readonly image2D radiance;

void main() {
    uint random = hashPixel(gl_GlobalInvocationID.xy, 193u, params.view.frame);
    uint place = random % (params.step * params.step);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy * params.step + uvec2(place % params.step, place / params.step));
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    vec4 light = imageLoad(radiance, pixel);
    if (d <= 0.0 || light.a < 0.0) {  // nothing is there, or no ray was traced in this frame
        return;
    }
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
    uint slot = findOrAddCacheCell(cachePlace(p, n, cacheCellSide(p, params.view.eye, params.cellSize)));
    if (slot != noCacheSlot) {
        feedCache(slot, clampToHalf(light.rgb) / params.unit, hashToUnit(hashPcg(random)));
    }
}
