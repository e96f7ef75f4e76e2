// Composites clear coats over the light of the surfaces beneath. In: the coats' depth, normals, material and share (in
// the image of their motion); their light; the light beneath. Out: the sum; its alpha is that of the light beneath.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "renderer/coat/coat.h"
#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { CoatOverParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform sampler2D material;
uniform sampler2D motion;
uniform sampler2D ggxTable;
uniform sampler2D layer;
uniform sampler2D behind;
layout(rgba16f) uniform writeonly image2D over;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    vec4 light = texelFetch(behind, pixel, 0);
    float d = texelFetch(depth, pixel, 0).r;
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
        float nv = dot(n, directionToEye(p, params.view.eye));
        MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
        float share = texelFetch(motion, pixel, 0).a;
        float reflected = share * surfaceAt(pixel, vec3(0.0), m, nv, ggxTable, false).specular.r;
        light.rgb = light.rgb * (1.0 - reflected) + share * texelFetch(layer, pixel, 0).rgb;
    }
    imageStore(over, pixel, roundToHalf(vec4(clampToHalf(light.rgb), light.a)));
}
