// Resamples radiance by a Catmull-Rom spline through what has a similar alpha, which is a distance: frames of ever another
// size resample it again and again, and a mean would blur it. Or the nearest texel. In, out: RGBA16F.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/rescale/rescale.h"
#include "shaders/catmull_rom.glsl"

layout(constant_id = 0) const uint nearest = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { RescaleParams params; };
uniform sampler2D from;
layout(rgba16f) uniform writeonly image2D to;

#include "effects/rescale/rescale.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) {
        return;
    }
    vec4 nearby = texelFetch(from, nearestOf(pixel), 0);
    if (nearest != 0u) {
        imageStore(to, pixel, nearby);
        return;
    }
    CatmullRom taps = catmullRom(sourceOf(pixel) - 0.5);
    vec4 sum = vec4(0.0);
    vec4 least = nearby;
    vec4 most = nearby;
    float weights = 0.0;
    for (int y = taps.first.y; y <= taps.last.y; ++y) {
        for (int x = taps.first.x; x <= taps.last.x; ++x) {
            vec4 texel = texelFetch(from, clampedTexel(taps.corner + ivec2(x, y)), 0);
            float like = likeness(texel.a, nearby.a);
            float weight = taps.x[x + 1] * taps.y[y + 1] * like;
            sum += weight * texel;
            weights += weight;
            least = min(least, mix(nearby, texel, like));
            most = max(most, mix(nearby, texel, like));
        }
    }
    imageStore(to, pixel, weights > 0.25 ? clamp(sum / weights, least, most) : nearby);
}
