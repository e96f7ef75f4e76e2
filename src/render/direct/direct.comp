// Direct light of sun and lamps, emission and background. In: G-buffer, visibility of sun and lamps. Out: direct radiance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/direct/direct.h"
#include "render/direct/lamp_tiles.h"
#include "render/gbuffer/gbuffer.glsl"
#include "shaders/half_float.glsl"
#include "shaders/lamp.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint lampTiles = 1u;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { DirectParams params; };
layout(set = 0, binding = 1, scalar) uniform LampUniforms { LampBlock lampBlock; };
layout(set = 0, binding = 2) uniform sampler2D depth;
layout(set = 0, binding = 3) uniform usampler2D normal;
layout(set = 0, binding = 4) uniform sampler2D baseColor;
layout(set = 0, binding = 5) uniform sampler2D material;
layout(set = 0, binding = 6) uniform sampler2D emissive;
layout(set = 0, binding = 7) uniform sampler2D sunVisibility;
layout(set = 0, binding = 8) uniform sampler2DArray lampVisibility;
layout(set = 0, binding = 9) uniform sampler2D ggxTable;
layout(set = 0, binding = 10) uniform usampler2DArray lampMasks;
layout(set = 0, binding = 11, rgba16f) uniform writeonly image2D direct;

float visibilityOfLamp(uint shadow, ivec2 pixel) {
    return shadow == noLampShadow ? 1.0 : texelFetch(lampVisibility, ivec3(pixel, shadow / 4u), 0)[shadow % 4u];
}

// The lamps from 32 · word on that may light a pixel, a bit for each.
uint lampsOf(ivec2 pixel, uint word) {
    if (lampTiles != 0u) {
        return texelFetch(lampMasks, ivec3(pixel >> int(lampTileShift), word / 4u), 0)[word % 4u];
    }
    uint left = lampBlock.count - 32u * word;
    return left >= 32u ? 0xFFFFFFFFu : (1u << left) - 1u;
}

vec3 lampLight(uint index, Surface s, vec3 p, vec3 n, vec3 v, ivec2 pixel) {
    vec3 toLamp;
    vec3 irradiance = lampIrradiance(lampBlock.lamps[index], p, toLamp);
    return reflectLight(s, n, v, toLamp) * irradiance * visibilityOfLamp(lampBlock.lamps[index].shadow, pixel);
}

vec3 radianceAt(ivec2 pixel) {
    float d = texelFetch(depth, pixel, 0).r;
    if (d <= 0.0) {
        return params.background;
    }
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
    vec3 v = directionToEye(p, params.view.eye);
    MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
    Surface s = surfaceAt(texelFetch(baseColor, pixel, 0).rgb, m, dot(n, v), ggxTable);

    float visibility = texelFetch(sunVisibility, pixel, 0).r;
    vec3 radiance = texelFetch(emissive, pixel, 0).rgb;
    radiance += reflectLight(s, n, v, params.toSun) * params.sunIrradiance * visibility;
    for (uint word = 0u; 32u * word < lampBlock.count; ++word) {
        for (uint bits = lampsOf(pixel, word); bits != 0u; bits &= bits - 1u) {
            radiance += lampLight(32u * word + uint(findLSB(bits)), s, p, n, v, pixel);
        }
    }
    return radiance;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.view.size)))) {
        imageStore(direct, pixel, vec4(clampToHalf(radianceAt(pixel)), 1.0));
    }
}
