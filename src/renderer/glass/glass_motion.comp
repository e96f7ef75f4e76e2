// What temporal antialiasing follows where there is glass: the nearest volume, whose refracted picture moves about as it
// does, or the opaque surfaces, also behind sheets, which show them where they are. In: depth and motion of both, the
// glass's thickness. Out: depth and motion.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/glass/glass.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { GlassOverParams params; };
uniform sampler2D depth;
uniform sampler2D motion;
uniform sampler2D layerDepth;
uniform sampler2D layerMotion;
uniform sampler2D tint;
layout(r32f) uniform writeonly image2D followedDepth;
layout(rgba16f) uniform writeonly image2D followedMotion;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    vec4 moved = texelFetch(motion, pixel, 0);
    float front = texelFetch(layerDepth, pixel, 0).r;
    if (front > d && texelFetch(tint, pixel, 0).a != 0.0) {
        d = front;
        moved.rgb = texelFetch(layerMotion, pixel, 0).rgb;
    }
    imageStore(followedDepth, pixel, vec4(d));
    imageStore(followedMotion, pixel, moved);
}
