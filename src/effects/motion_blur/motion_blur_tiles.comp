// The longest half streak of each run of texels along one axis: twice, and it is that of a tile. In: half streaks. Out: the longest.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/motion_blur/motion_blur.h"
#include "shaders/not_inlined.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { MotionBlurTileParams params; };
uniform sampler2D streaks;
layout(rg16f) uniform writeonly image2D longest;

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.to)))) {
        return;
    }
    ivec2 along = ivec2(params.step);
    ivec2 last = ivec2(params.from) - 1;
    int side = int(notInlined(params.side, gl_GlobalInvocationID.x));
    ivec2 first = cell * (ivec2(1) + along * (side - 1));
    vec2 most = vec2(0.0);
    for (int i = 0; i < side; ++i) {
        vec2 streak = texelFetch(streaks, min(first + i * along, last), 0).rg;
        most = dot(streak, streak) > dot(most, most) ? streak : most;
    }
    imageStore(longest, cell, vec4(most, 0.0, 0.0));
}
