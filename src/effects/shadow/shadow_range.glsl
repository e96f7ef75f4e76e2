// Builds two levels of the shadow map's min/max pyramid. In: the map (levels 1 and 2), or the level below. Out: both
// levels, in the same image.
// shadow_depth.glsl says what the map is.
#include "effects/levels.glsl"
#include "effects/shadow/shadow.h"

layout(constant_id = 0) const uint fromMap = 0u;  // 1: level 1 and 2

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ShadowRangeParams params; };
#include "effects/shadow/shadow_depth.glsl"
layout(rg32f) uniform image2D range;

ivec2 texels = ivec2(params.size);
ivec2 cells = levelSize(texels, 2);
int level = int(params.level);

// Combines two (max, min) pairs.
vec2 ofBoth(vec2 a, vec2 b) { return vec2(max(a.x, b.x), min(a.y, b.y)); }

void store(ivec2 cell, int at, vec2 value) {
    imageStore(range, cell + ivec2(0, levelRow(cells, at)), vec4(value, 0.0, 0.0));
}

vec2 ofTexels(ivec2 cell) {
    const int side = 2 * int(shadowRangeTexels);
    vec2 all = vec2(0.0, 1.0);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            all = ofBoth(all, vec2(shadowDepth(min(side * cell + ivec2(x, y), texels - 1))));
        }
    }
    return all;
}

vec2 below(ivec2 cell) {
    cell = min(cell, levelSize(cells, level - 1) - 1);  // with odd sizes the last cell is read twice
    return imageLoad(range, cell + ivec2(0, levelRow(cells, level - 1))).rg;
}

vec2 make(ivec2 cell) {
    cell = min(cell, levelSize(cells, level) - 1);
    vec2 all = fromMap != 0u ? ofTexels(cell)
                             : ofBoth(ofBoth(below(2 * cell), below(2 * cell + ivec2(1, 0))),
                                      ofBoth(below(2 * cell + ivec2(0, 1)), below(2 * cell + ivec2(1, 1))));
    store(cell, level, all);
    return all;
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, levelSize(cells, level + 1)))) {
        return;
    }
    vec2 all = ofBoth(ofBoth(make(2 * cell), make(2 * cell + ivec2(1, 0))),
                      ofBoth(make(2 * cell + ivec2(0, 1)), make(2 * cell + ivec2(1, 1))));
    store(cell, level + 1, all);
}
