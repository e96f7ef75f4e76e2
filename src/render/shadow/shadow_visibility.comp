// Whether each pixel sees the sun, by one texel of its map. In: depth, geometric normal, shadow map. Out: visibility, 1 lit.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/shadow/shadow.h"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { ShadowVisibilityParams params; };
layout(set = 0, binding = 1) uniform sampler2D depth;
layout(set = 0, binding = 2) uniform usampler2D geometricNormal;
layout(set = 0, binding = 3) uniform sampler2D shadowMap;
layout(set = 0, binding = 4, r8) uniform writeonly image2D visibility;

float loadShadowDepth(ivec2 texel) { return texelFetch(shadowMap, texel, 0).r; }
#include "shaders/shadow_map.glsl"

float visibilityAt(ivec2 pixel) {
    float d = texelFetch(depth, pixel, 0).r;
    if (d <= 0.0 || params.settings.filter == ShadowFilter_none) {
        return 1.0;
    }
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    ivec2 size = textureSize(shadowMap, 0);
    if (params.settings.biasKind == ShadowBias_constant) {
        return hardVisibility(constantReceiver(p, params.map, size, params.settings.constantBias));
    }
    vec3 n = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    if (dot(n, params.map.toSun) <= 0.0) {
        return 0.0;  // the surface is in its own shadow
    }
    return hardVisibility(slopeReceiver(p, n, params.map, size, params.settings.bias));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.view.size)))) {
        imageStore(visibility, pixel, vec4(visibilityAt(pixel)));
    }
}
