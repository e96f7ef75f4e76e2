// Half streaks: how far what a pixel shows moves in half of the time that the shutter is open. In: depth, motion. Out: half streak
// in pixels of the picture; its length; distance in front of the camera, at most farthest.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/motion_blur/motion_blur.h"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint hasMotion = 1u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { MotionBlurStreakParams params; };
uniform sampler2D depth;
uniform sampler2D motion;
layout(rgba16f) uniform writeonly image2D streaks;

const float farthest = 60000.0;  // metres: a half float's range

// uv now minus uv in the last frame, of what is at rest; 0 if that was behind the camera. d: its depth; 0: background.
vec2 motionAtRest(ivec2 pixel, float d) {
    vec2 uv = pixelToUv(pixel, 1.0 / vec2(params.size));
    vec4 before = params.toPrevious * vec4(uvToNdc(uv), d, 1.0);
    return before.w > 0.0 ? uv - ndcToUv(before.xy / before.w) : vec2(0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.size)))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    bool surface = d > 0.0 && d <= 1.0;
    vec2 moved = surface && hasMotion != 0u ? texelFetch(motion, pixel, 0).rg : motionAtRest(pixel, surface ? d : 0.0);
    bool known = all(lessThan(abs(moved), vec2(64.0)));  // false for NaN
    vec2 streak = known ? moved * params.toHalfStreak : vec2(0.0);
    float pixels = length(streak);
    streak *= min(1.0, params.longest / max(pixels, 1e-6));
    float z = surface ? depthToViewDistance(d, params.depthToDistance) : farthest;
    imageStore(streaks, pixel, vec4(streak, min(pixels, params.longest), clamp(z, 1e-4, farthest)));
}
