// Builds one mip level of a radiance image. In: the image (level 1), or the level below. Out: the level, in the same
// image.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/levels.glsl"
#include "effects/light_mips/light_mips.h"
#include "shaders/not_inlined.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { LightMipsParams params; };
uniform sampler2D light;
layout(rgba16f) uniform image2D mips;

ivec2 pixels = ivec2(params.size);
int level = int(notInlined(params.level, gl_GlobalInvocationID.x));

// Sum over the pixels of a cell of the finer level; alpha: their number.
vec4 below(ivec2 cell) {
    ivec2 sides = min((cell + 1) << (level - 1), pixels) - (cell << (level - 1));
    if (any(lessThanEqual(sides, ivec2(0)))) {
        return vec4(0.0);  // outside, with odd sizes
    }
    vec3 radiance = level == 1 ? texelFetch(light, cell, 0).rgb
                               : imageLoad(mips, cell + ivec2(0, levelRow(pixels, level - 1))).rgb;
    return vec4(radiance, 1.0) * float(sides.x * sides.y);
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, levelSize(pixels, level)))) {
        return;
    }
    vec4 sum = below(2 * cell) + below(2 * cell + ivec2(1, 0)) + below(2 * cell + ivec2(0, 1)) +
               below(2 * cell + ivec2(1, 1));
    imageStore(mips, cell + ivec2(0, levelRow(pixels, level)), vec4(sum.rgb / sum.a, 1.0));
}
