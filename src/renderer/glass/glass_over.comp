// Composites a layer of glass over the light behind it. In: the layer's depth, its coverage (in the image of its
// motion) and its own light; the light at the ends of its refracted rays, also denoised, and their shares; the light
// behind. Out: the sum; its alpha is that of the light behind.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer.glsl"
#include "renderer/glass/glass.h"
#include "shaders/half_float.glsl"

layout(constant_id = 0) const uint transmits = 1u;
layout(constant_id = 1) const uint disperses = 0u;
layout(constant_id = 2) const uint denoises = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { GlassOverParams params; };
uniform sampler2D depth;
uniform sampler2D motion;
uniform sampler2D material;
uniform sampler2D denoised;
uniform sampler2D layer;
uniform sampler2D behind;
uniform sampler2D share;
layout(rgba16f) uniform readonly image2DArray answer;
layout(rgba16f) uniform writeonly image2D over;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    vec4 light = texelFetch(behind, pixel, 0);
    if (texelFetch(depth, pixel, 0).r > 0.0) {
        vec3 own = texelFetch(layer, pixel, 0).rgb;
        if (transmits != 0u) {
            vec4 passed = texelFetch(share, pixel, 0);
            vec3 beyond = imageLoad(answer, ivec3(pixel, 0)).rgb;
            if (disperses != 0u && passed.a > 1.0) {
                beyond.g = imageLoad(answer, ivec3(pixel, 1)).g;
                beyond.b = imageLoad(answer, ivec3(pixel, 2)).b;
            }
            if (denoises != 0u && unpackMaterial(texelFetch(material, pixel, 0)).roughness > frostedFrom) {
                beyond = texelFetch(denoised, pixel, 0).rgb;
            }
            own += passed.rgb * beyond;
        }
        light.rgb = mix(light.rgb, own, texelFetch(motion, pixel, 0).a);
    }
    imageStore(over, pixel, roundToHalf(vec4(clampToHalf(light.rgb), light.a)));
}
