// The signed circle of confusion. In: depth. Out: its radius in pixels of the picture.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/depth_of_field.h"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofCocParams params; };
uniform sampler2D depth;
layout(r32f) uniform writeonly image2D coc;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.size)))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    float z = depthToViewDistance(d, params.depthToDistance);
    vec4 lens = params.lens;
    // Perspective: the image of a disk shrinks with the distance.
    float defocus = lens.z > 0.0 ? z * lens.y - 1.0 : 1.0 - 1.0 / max(z * lens.y, 1e-9);
    imageStore(coc, pixel, vec4(clamp(lens.x * defocus, -lens.w, lens.w)));
}
