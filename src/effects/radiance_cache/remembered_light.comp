// What the cache knows of the light that visible surfaces receive, for pixels without a history: behind what has moved, or after
// a cut.
// In: surfaces; the cache. Out: mean incoming radiance, cosine-weighted; alpha: frames that it stands for, 0: unknown.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/radiance_cache/radiance_cache.glsl"
#include "shaders/ggx.glsl"
#include "shaders/half_float.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { RememberedLightParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
layout(rgba16f) uniform writeonly image2D remembered;

// Cells are blurred, and may be of the light before a change: soon, frames of their own shall count more.
const float mostFrames = 6.0;
const int places = 4;  // cells to ask, around the pixel

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), max(d, 1e-12), params.view.clipToWorld);
    vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
    mat3 frame = basisAround(unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r));
    float side = cacheCellSide(p, params.view.eye, params.cellSize);
    uint random = hashPixel(uvec2(pixel), 191u, params.view.frame);
    vec3 sum = vec3(0.0);
    float samples = 0.0;
    int count = d > 0.0 && params.view.rest < 2u ? places : 0;  // at rest all pixels have a history
    for (int i = 0; i < count; ++i) {
        // Each in a quarter of a square of two cells' side: their borders blur.
        vec2 at = (vec2(i & 1, i >> 1) - 1.0 + hashToUnit2(random)) * side;
        random = hashPcg(random);
        uint slot = findCacheCell(cachePlace(p + frame * vec3(at, 0.0), n, side));
        if (slot != noCacheSlot) {
            CacheCell c = cacheCells.items[slot];
            sum += c.weight * c.mean;
            samples += c.weight;
        }
    }
    vec3 mean = clampToHalf(params.unit * sum / max(samples, 1e-6));
    imageStore(remembered, pixel, vec4(mean, min(samples, mostFrames)));
}
