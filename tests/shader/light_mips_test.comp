// Looks up blurred light in an image and its mips.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "light_mips_test.h"
#include "effects/levels.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { LightLookup items[]; } inputs;
layout(scalar) buffer OutputBlock { vec3 items[]; } outputs;
uniform sampler2D light;
uniform sampler2D mips;

vec3 loadLight(ivec2 cell, int level) {
    return level > 0 ? texelFetch(mips, cell + ivec2(0, levelRow(textureSize(light, 0), level)), 0).rgb
                     : texelFetch(light, cell, 0).rgb;
}
#include "effects/light_mips/light_mips.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        LightLookup item = inputs.items[i];
        outputs.items[i] = blurredLight(item.at, item.width, textureSize(light, 0));
    }
}
