// Running means of the light layers. In: this frame's layers, the previous means. Out: the new means, and their sum.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/accumulate/accumulate.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { AccumulateParams params; };
layout(set = 0, binding = 1, rgba16f) uniform readonly image2D direct;
layout(set = 0, binding = 2, rgba16f) uniform readonly image2D indirectDiffuse;
layout(set = 0, binding = 3, rgba16f) uniform readonly image2D indirectSpecular;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D directBefore;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D indirectDiffuseBefore;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D indirectSpecularBefore;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D directMean;
layout(set = 0, binding = 8, rgba32f) uniform writeonly image2D indirectDiffuseMean;
layout(set = 0, binding = 9, rgba32f) uniform writeonly image2D indirectSpecularMean;
layout(set = 0, binding = 10, rgba32f) uniform writeonly image2D litMean;

// In the first frame there is no previous mean; the image's contents, possibly NaN, must be ignored.
vec3 meanOf(vec3 now, vec3 before) { return params.weight < 1.0 ? mix(before, now, params.weight) : now; }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    vec3 a = meanOf(imageLoad(direct, pixel).rgb, imageLoad(directBefore, pixel).rgb);
    vec3 b = meanOf(imageLoad(indirectDiffuse, pixel).rgb, imageLoad(indirectDiffuseBefore, pixel).rgb);
    vec3 c = meanOf(imageLoad(indirectSpecular, pixel).rgb, imageLoad(indirectSpecularBefore, pixel).rgb);
    imageStore(directMean, pixel, vec4(a, 1.0));
    imageStore(indirectDiffuseMean, pixel, vec4(b, 1.0));
    imageStore(indirectSpecularMean, pixel, vec4(c, 1.0));
    imageStore(litMean, pixel, vec4(a + b + c, 1.0));
}
