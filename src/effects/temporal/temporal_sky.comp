// The environment where nothing is in front of it, in a picture whose camera moves: the mean over each pixel's area,
// which needs no history. A history that is resampled every frame would blur stars, and clipping would take them away.
// In: depth of the frame, the environment. Out: the history's mean, there.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/environment/environment.glsl"
#include "effects/temporal/temporal.h"
#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { TemporalSkyParams params; };
uniform sampler2D depth;
layout(rgba16f) uniform writeonly image2D mean;

// Whether no sample around the pixel shows a surface.
bool isSky(vec2 at) {
    ivec2 last = ivec2(params.view.size) - 1;
    ivec2 nearest = ivec2(floor(at));
    float covered = 0.0;
    for (int i = 0; i < 9; ++i) {
        covered = max(covered, texelFetch(depth, clamp(nearest + ivec2(i % 3, i / 3) - 1, ivec2(0), last), 0).r);
    }
    return covered <= 0.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(mean)))) {
        return;
    }
    // In the frame's pixels, as temporal_upscale.glsl.
    vec2 at = (vec2(pixel) + 0.5) * params.ratio - params.jitter;
    if (!isSky(at)) {
        return;
    }
    vec2 size = params.view.size;
    mat4 toWorld = params.view.clipToWorld;
    vec3 middle = viewDirection(at / size, toWorld, params.view.eye);
    vec3 right = viewDirection((at + vec2(params.ratio.x, 0.0)) / size, toWorld, params.view.eye) - middle;
    vec3 down = viewDirection((at + vec2(0.0, params.ratio.y)) / size, toWorld, params.view.eye) - middle;
    imageStore(mean, pixel, vec4(roundToHalf(vec4(environmentMean(middle, right, down), 1.0)).rgb, params.frames));
}
