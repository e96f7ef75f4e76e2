// View rays to a layer of glass. In: the layer's depth and tint. Out: the list of rays and their directions; their share, which is
// the tint.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/rays.glsl"
#include "renderer/glass/glass.h"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ViewParams params; };
uniform sampler2D depth;
uniform sampler2D tint;
layout(rgba16f) uniform writeonly image2D share;
layout(rg32ui) uniform writeonly uimage2DArray direction;
layout(rgba16f) uniform writeonly image2DArray answer;
layout(rgba8) uniform writeonly image2DArray source;
#include "effects/lobe/rays_append.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.size)))) {
        return;
    }
    ivec3 slot = ivec3(pixel, 0);
    imageStore(answer, slot, vec4(0.0));
    imageStore(source, slot, vec4(0.0));
    float d = texelFetch(depth, pixel, 0).r;
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.pixel), d, params.clipToWorld);
        Ray ray = Ray(-directionToEye(p, params.eye), 1.0, 1.0, 0.0, false);
        imageStore(direction, slot, uvec4(packRay(ray), 0u, 0u));
        imageStore(share, pixel, vec4(texelFetch(tint, pixel, 0).rgb, 1.0));
        appendRay(WaitingRay(slot, 1.0, 0.0, false, vec3(0.0)));
    }
}
