// Running means of the light layers. In: this frame's layers, the previous means. Out: the new means, and their sum.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/accumulate/accumulate.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { AccumulateParams params; };
layout(rgba16f) uniform readonly image2D direct;
layout(rgba16f) uniform readonly image2D indirectDiffuse;
layout(rgba16f) uniform readonly image2D indirectSpecular;
layout(rgba32f) uniform readonly image2D directBefore;
layout(rgba32f) uniform readonly image2D indirectDiffuseBefore;
layout(rgba32f) uniform readonly image2D indirectSpecularBefore;
layout(rgba32f) uniform writeonly image2D directMean;
layout(rgba32f) uniform writeonly image2D indirectDiffuseMean;
layout(rgba32f) uniform writeonly image2D indirectSpecularMean;
layout(rgba32f) uniform writeonly image2D litMean;

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
