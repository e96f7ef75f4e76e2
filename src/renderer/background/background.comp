// Puts the background where there is no surface. In: depth, direct and all radiance, the background. Out: both with it,
// and which pixels have a surface.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/background/background.h"
#include "effects/environment/environment.glsl"
#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { BackgroundParams params; };
uniform sampler2D depth;
uniform sampler2D direct;
uniform sampler2D lit;
layout(rgba16f) uniform writeonly image2D directOver;
layout(rgba16f) uniform writeonly image2D litOver;
layout(rgba16f) uniform writeonly image2D coverage;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    vec4 fromDirect = texelFetch(direct, pixel, 0);
    vec4 fromAll = texelFetch(lit, pixel, 0);
    float surface = texelFetch(depth, pixel, 0).r > 0.0 ? 1.0 : 0.0;
    if (surface == 0.0) {
        vec2 uv = pixelToUv(pixel, params.view.pixel);
        vec3 behind = environmentRadiance(viewDirection(uv, params.view.clipToWorld, params.view.eye));
        fromDirect.rgb = clampToHalf(behind);
        fromAll.rgb = fromDirect.rgb;
    }
    imageStore(directOver, pixel, fromDirect);
    imageStore(litOver, pixel, fromAll);
    imageStore(coverage, pixel, vec4(vec3(surface), 1.0));
}
