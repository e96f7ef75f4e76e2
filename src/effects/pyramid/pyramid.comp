// Builds one level of the hierarchical depth buffer. In: depth of the first layer and of the second (level 1), or the
// level below.
// Out: the level, in the same image.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/levels.glsl"
#include "effects/pyramid/pyramid.h"
#include "shaders/not_inlined.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { PyramidParams params; };
uniform sampler2D depth;
uniform sampler2D backDepth;
layout(rg32f) uniform image2D pyramid;

ivec2 pixels = ivec2(params.size);
int level = int(notInlined(params.level, gl_GlobalInvocationID.x));

vec2 below(ivec2 cell) {
    cell = min(cell, levelSize(pixels, level - 1) - 1);  // with odd sizes the last cell is read twice
    if (level == 1) {
        float front = texelFetch(depth, cell, 0).r;
        float back = notInlined(params.secondLayer, gl_GlobalInvocationID.x) != 0u ? texelFetch(backDepth, cell, 0).r : 0.0;
        return vec2(front, front <= 0.0 ? -1.0 : back > 0.0 ? back : front);
    }
    return imageLoad(pyramid, cell + ivec2(0, levelRow(pixels, level - 1))).rg;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, levelSize(pixels, level)))) {
        return;
    }
    vec2 a = below(2 * cell);
    vec2 b = below(2 * cell + ivec2(1, 0));
    vec2 c = below(2 * cell + ivec2(0, 1));
    vec2 d = below(2 * cell + ivec2(1, 1));
    float nearest = max(max(a.x, b.x), max(c.x, d.x));
    float farthest = min(min(abs(a.y), abs(b.y)), min(abs(c.y), abs(d.y)));
    bool sky = min(min(a.y, b.y), min(c.y, d.y)) < 0.0;
    imageStore(pyramid, cell + ivec2(0, levelRow(pixels, level)), vec4(nearest, sky ? -farthest : farthest, 0.0, 0.0));
}
