// Resamples moments: the mean of what lies around and has a similar history length, in red. In, out: RG16F.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/rescale/rescale.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { RescaleParams params; };
uniform sampler2D from;
layout(rg16f) uniform writeonly image2D to;

#include "effects/rescale/rescale.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) {
        return;
    }
    vec2 nearby = texelFetch(from, nearestOf(pixel), 0).rg;
    vec2 at = sourceOf(pixel) - 0.5;
    ivec2 first = ivec2(floor(at));
    vec2 part = at - vec2(first);
    vec2 sum = vec2(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec2 texel = texelFetch(from, clampedTexel(first + corner), 0).rg;
        vec2 w = mix(1.0 - part, part, vec2(corner));
        float weight = w.x * w.y * likeness(texel.r, nearby.r);
        sum += weight * texel;
        weights += weight;
    }
    imageStore(to, pixel, vec4(weights > 1e-3 ? sum / weights : nearby, 0.0, 0.0));
}
