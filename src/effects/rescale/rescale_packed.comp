// Resamples packed values: the nearest texel, but its depth, which is linear on a plane, where the texel's centre comes to
// lie. Otherwise steep surfaces would not be recognized. In, out: RG32_UINT.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/rescale/rescale.h"

layout(constant_id = 0) const uint depthInGreen = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { RescaleParams params; };
uniform usampler2D from;
layout(rg32ui) uniform writeonly uimage2D to;

#include "effects/rescale/rescale.glsl"

float depthAt(ivec2 texel) { return uintBitsToFloat(texelFetch(from, clampedTexel(texel), 0)[depthInGreen]); }

// Per texel; of both sides the one that is less steep belongs to the same surface.
float slope(ivec2 texel, ivec2 along, float depth) {
    float before = depth - depthAt(texel - along);
    float after = depthAt(texel + along) - depth;
    bool atStart = any(lessThan(texel - along, ivec2(0)));
    bool atEnd = any(greaterThanEqual(texel + along, ivec2(params.from)));
    bool useBefore = atEnd || (!atStart && abs(before) < abs(after));
    return useBefore ? before : after;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) {
        return;
    }
    ivec2 texel = nearestOf(pixel);
    uvec4 nearby = texelFetch(from, texel, 0);
    float depth = uintBitsToFloat(nearby[depthInGreen]);
    vec2 off = sourceOf(pixel) - 0.5 - vec2(texel);
    float there = depth + off.x * slope(texel, ivec2(1, 0), depth) + off.y * slope(texel, ivec2(0, 1), depth);
    // 0: there is no surface.
    nearby[depthInGreen] = floatBitsToUint(depth > 0.0 ? clamp(there, 0.5 * depth, 2.0 * depth) : 0.0);
    imageStore(to, pixel, nearby);
}
