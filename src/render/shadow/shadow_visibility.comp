// How much of the sun each pixel sees. In: depth, geometric normal, shadow maps. Out: visibility, 1 lit; and, where
// there are cascades, which of them was asked.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/shadow/shadow.h"
#include "shaders/cascades.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { ShadowVisibilityParams params; };
layout(set = 0, binding = 1) uniform sampler2D depth;
layout(set = 0, binding = 2) uniform usampler2D geometricNormal;
layout(set = 0, binding = 3) uniform sampler2D shadowMap;
layout(set = 0, binding = 4, r8) uniform writeonly image2D visibility;
layout(set = 0, binding = 5, r8) uniform writeonly image2D cascadeIndex;

ivec2 tile;  // of the cascade that is looked up
float loadShadowDepth(ivec2 texel) { return texelFetch(shadowMap, tile + texel, 0).r; }
#include "shaders/shadow_map.glsl"

float visibilityIn(uint cascade, vec3 p, ivec2 pixel) {
    ivec2 size = ivec2(params.settings.resolution);
    tile = cascadeTile(cascade, params.settings.resolution);
    if (params.settings.biasKind == ShadowBias_constant) {
        return constantBiasVisibility(p, params.sun.maps[cascade], size, params.settings.constantBias);
    }
    vec3 n = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    return hardVisibility(p, n, params.sun.maps[cascade], size, params.settings.bias);
}

float visibilityAt(vec3 p, Cascade c, ivec2 pixel) {
    float lit = visibilityIn(c.index, p, pixel);
    return c.next > 0.0 ? mix(lit, visibilityIn(c.index + 1u, p, pixel), c.next) : lit;
}

void look(ivec2 pixel) {
    float d = texelFetch(depth, pixel, 0).r;
    float lit = 1.0;
    Cascade c = Cascade(params.sun.count - 1u, 0.0);  // of the sky
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        c = cascadeAt(dot(params.view.viewPlane, vec4(p, 1.0)), params.sun);
        lit = params.settings.filter == ShadowFilter_none ? 1.0 : visibilityAt(p, c, pixel);
    }
    imageStore(visibility, pixel, vec4(lit));
    if (params.sun.count > 1u) {
        imageStore(cascadeIndex, pixel, vec4((float(c.index) + c.next) / float(maxCascades - 1u)));
    }
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.view.size)))) {
        look(pixel);
    }
}
