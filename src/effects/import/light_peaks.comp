// The peak of each tile of a host's light. In: light, the last frame's peaks. Out: peaks; of several lights in a frame
// that of all.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/import/bound_light.h"
#include "shaders/luminance.glsl"
#include "shaders/not_inlined.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { LightPeakParams params; };
uniform sampler2D light;
layout(r32f) uniform readonly image2D previous;
layout(r32f) uniform image2D peaks;

// A thin bar that few frames show keeps a quarter of its peak for 28 frames.
const float kept = 0.95;

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 first = tile * int(boundTileSide);
    ivec2 end = min(first + int(boundTileSide), ivec2(params.size));
    if (any(greaterThanEqual(first, end))) {
        return;
    }
    float peak = 0.0;
    uint from = notInlined(params.from, gl_GlobalInvocationID.x);
    if (from == lightPeaksAdd) {
        peak = imageLoad(peaks, tile).r;
    } else if (from == lightPeaksNext) {
        peak = kept * params.exposureChange * imageLoad(previous, tile).r;
    }
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            peak = max(peak, luminance(texelFetch(light, ivec2(x, y), 0).rgb));
        }
    }
    imageStore(peaks, tile, vec4(peak));
}
