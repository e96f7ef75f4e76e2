// Indirect light times what the surface reflects of it, and the sum of all light. In: G-buffer, direct light, the
// lobes' mean radiance. Out: both indirect layers, and lit = direct + both.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/composite/composite.h"
#include "render/gbuffer/gbuffer.glsl"
#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { CompositeParams params; };
layout(set = 0, binding = 1) uniform sampler2D depth;
layout(set = 0, binding = 2) uniform usampler2D normal;
layout(set = 0, binding = 3) uniform sampler2D baseColor;
layout(set = 0, binding = 4) uniform sampler2D material;
layout(set = 0, binding = 5) uniform sampler2D ggxTable;
layout(set = 0, binding = 6, rgba16f) uniform readonly image2D direct;
layout(set = 0, binding = 7, rgba16f) uniform readonly image2D diffuse;
layout(set = 0, binding = 8, rgba16f) uniform readonly image2D specular;
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D indirectDiffuse;
layout(set = 0, binding = 10, rgba16f) uniform writeonly image2D indirectSpecular;
layout(set = 0, binding = 11, rgba16f) uniform writeonly image2D lit;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    vec3 fromDiffuse = vec3(0.0);
    vec3 fromSpecular = vec3(0.0);
    float d = texelFetch(depth, pixel, 0).r;
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
        float nv = dot(n, directionToEye(p, params.view.eye));
        MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
        Surface s = surfaceAt(texelFetch(baseColor, pixel, 0).rgb, m, nv, ggxTable);
        fromDiffuse = params.diffuseGain * s.diffuse * imageLoad(diffuse, pixel).rgb;
        fromSpecular = s.specular * imageLoad(specular, pixel).rgb;
    }
    imageStore(indirectDiffuse, pixel, vec4(clampToHalf(fromDiffuse), 1.0));
    imageStore(indirectSpecular, pixel, vec4(clampToHalf(fromSpecular), 1.0));
    vec3 sum = imageLoad(direct, pixel).rgb + fromDiffuse + fromSpecular;
    imageStore(lit, pixel, vec4(clampToHalf(sum), 1.0));
}
