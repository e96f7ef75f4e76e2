// Divides premultiplied radiance by its coverage. In: both. Out: radiance, 0 where nothing is covered.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/background/background.h"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { StraightParams params; };
uniform sampler2D premultiplied;
uniform sampler2D coverage;
layout(rgba16f) uniform writeonly image2D radiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(uvec2(pixel), params.size))) {
        float covered = texelFetch(coverage, pixel, 0).r;
        vec3 c = covered > 0.0 ? texelFetch(premultiplied, pixel, 0).rgb / covered : vec3(0.0);
        imageStore(radiance, pixel, vec4(clampToHalf(c), 1.0));
    }
}
