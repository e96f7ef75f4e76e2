// Stores one face of a probe's cube map, mirrored (see cubeFaceCamera). In: depth and direct light of the face's camera.
// Out: radiance, 0 for the sky, with alpha; distance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/probe/capture_probe.h"
#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { CaptureProbeParams params; };
layout(set = 0, binding = 1) uniform sampler2D depth;
layout(set = 0, binding = 2, rgba16f) uniform readonly image2D direct;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2DArray radiance;
layout(set = 0, binding = 4, r32f) uniform writeonly image2DArray distance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(params.view.size);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    ivec3 texel = ivec3(size.x - 1 - pixel.x, pixel.y, params.layer);
    float d = texelFetch(depth, pixel, 0).r;
    if (d <= 0.0) {
        imageStore(radiance, texel, vec4(0.0));
        imageStore(distance, texel, vec4(0.0));
        return;
    }
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    imageStore(radiance, texel, roundToHalf(vec4(clampToHalf(imageLoad(direct, pixel).rgb), 1.0)));
    imageStore(distance, texel, vec4(length(p - params.view.eye.xyz)));
}
