// Builds two levels of the hierarchical depth buffer. In: depth of the first layer and of the second (levels 1 and 2), or
// the level below. Out: both levels, in the same image; with level 1 also level 0.
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

// Nearest and farthest depth; negative, the latter also tells of sky.
vec2 ofBoth(vec2 a, vec2 b) {
    float farthest = min(abs(a.y), abs(b.y));
    return vec2(max(a.x, b.x), min(a.y, b.y) < 0.0 ? -farthest : farthest);
}

void store(ivec2 cell, int at, vec2 value) { imageStore(pyramid, levelPlace(cell, at, pixels), vec4(value, 0.0, 0.0)); }

vec2 below(ivec2 cell) {
    cell = min(cell, levelSize(pixels, level - 1) - 1);  // with odd sizes the last cell is read twice
    if (level == 1) {
        float front = texelFetch(depth, cell, 0).r;
        float back = notInlined(params.secondLayer, gl_GlobalInvocationID.x) != 0u ? texelFetch(backDepth, cell, 0).r : 0.0;
        store(cell, 0, vec2(front, back));
        return vec2(front, front <= 0.0 ? -1.0 : back > 0.0 ? back : front);
    }
    return imageLoad(pyramid, levelPlace(cell, level - 1, pixels)).rg;
}

vec2 make(ivec2 cell) {
    cell = min(cell, levelSize(pixels, level) - 1);
    vec2 all = ofBoth(ofBoth(below(2 * cell), below(2 * cell + ivec2(1, 0))),
                      ofBoth(below(2 * cell + ivec2(0, 1)), below(2 * cell + ivec2(1, 1))));
    store(cell, level, all);
    return all;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, levelSize(pixels, level + 1)))) {
        return;
    }
    vec2 all = ofBoth(ofBoth(make(2 * cell), make(2 * cell + ivec2(1, 0))),
                      ofBoth(make(2 * cell + ivec2(0, 1)), make(2 * cell + ivec2(1, 1))));
    store(cell, level + 1, all);
}
