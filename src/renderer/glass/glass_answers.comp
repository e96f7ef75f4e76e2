// The answers of rays through glass, one per pixel, as an image of its own. In: the answers. Out: radiance, hit distance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/glass/glass.h"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { GlassOverParams params; };
layout(rgba16f) uniform readonly image2DArray answer;
layout(rgba16f) uniform writeonly image2D light;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(uvec2(pixel), params.size))) {
        vec4 found = imageLoad(answer, ivec3(pixel, 0));
        imageStore(light, pixel, vec4(clampToHalf(found.rgb), found.a));
    }
}
