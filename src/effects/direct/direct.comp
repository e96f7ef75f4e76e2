// Direct light of sun and lamps, emission and background. In: G-buffer, visibility of sun and lamps, lamp masks per
// tile.
// Out: direct radiance; the parts of it that lamps bring which stand for emissive surfaces, or for the sun in mirrors:
// diffuse light and the sun's, and highlights of emitters.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/direct/direct.h"
#include "effects/environment/environment.glsl"
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "shaders/emitter_highlight.glsl"
#include "shaders/half_float.glsl"
#include "shaders/lamp.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint lambertOnly = 0u;
layout(constant_id = 1) const uint anyLamps = 1u;
layout(constant_id = 3) const uint coloredSun = 0u;  // 1: glass has coloured the sunlight

layout(constant_id = 4) const uint hidesSunInMirrors = 0u;
layout(constant_id = 5) const uint highlights = 0u;  // emitters have highlights

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DirectParams params; };
layout(scalar) uniform LampUniforms { LampBlock lampBlock; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform sampler2D baseColor;
uniform sampler2D material;
uniform sampler2D emissive;
uniform sampler2D sunVisibility;
uniform sampler2DArray lampVisibility;
uniform sampler2D ggxTable;
uniform usampler2DArray lampMasks;
layout(rgba16f) uniform writeonly image2D direct;
layout(rgba16f) uniform writeonly image2D fromEmitters;
layout(rgba16f) uniform writeonly image2D emitterHighlights;

uvec4 loadLampMask(ivec3 texel) { return texelFetch(lampMasks, texel, 0); }
#include "shaders/lamp_mask.glsl"

float visibilityOfLamp(uint shadow, ivec2 pixel) {
    return shadow == noLampShadow ? 1.0 : texelFetch(lampVisibility, ivec3(pixel, shadow / 4u), 0)[shadow % 4u];
}

// What lamps bring that stand for emissive surfaces, or for the sun in mirrors.
struct IndirectParts {
    vec3 emitters;
    vec3 highlights;  // of emitters
};

vec3 lampLight(uint index, Surface s, vec3 p, vec3 n, vec3 v, ivec2 pixel, inout IndirectParts parts) {
    vec3 toLamp;
    LampParams lamp = lampBlock.lamps[index];
    vec3 irradiance = lampIrradiance(lamp, p, toLamp) * visibilityOfLamp(lamp.shadow, pixel);
    vec3 light = brdfTimesCosine(surfaceFor(lamp, s), n, v, toLamp) * irradiance;
    parts.emitters += lamp.type == lampEmitter || lamp.type == lampReflected ? light : vec3(0.0);
    if (highlights != 0u && lamp.type == lampEmitter) {
        float share = highlightShare(s.roughness, params.roughestHighlight);
        vec3 highlight = share * emitterHighlight(lamp, s, p, n, v, toLamp) * irradiance;
        parts.highlights += highlight;
        light += highlight;
    }
    return light;
}

vec3 radianceAt(ivec2 pixel, out IndirectParts parts) {
    parts = IndirectParts(vec3(0.0), vec3(0.0));
    float d = texelFetch(depth, pixel, 0).r;
    if (d <= 0.0) {
        vec2 uv = pixelToUv(pixel, params.view.pixel);
        return environmentRadiance(viewDirection(uv, params.view.clipToWorld, params.view.eye));
    }
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
    vec3 v = directionToEye(p, params.view.eye);
    MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
    vec3 base = texelFetch(baseColor, pixel, 0).rgb;
    Surface s = surfaceAt(pixel, base, m, dot(n, v), ggxTable, lambertOnly != 0u);

    vec3 visibility = texelFetch(sunVisibility, pixel, 0).rgb;
    visibility = coloredSun != 0u ? visibility : visibility.rrr;
    vec3 radiance = emissionAt(texelFetch(emissive, pixel, 0).rgb, base, m, params.view.preExposure);
    Surface underSun = s;
    underSun.roughness = max(s.roughness, params.sunRoughness);
    if (hidesSunInMirrors != 0u && s.roughness <= smoothestMirror) {
        underSun.f0 = vec3(0.0);
        underSun.f90 = 0.0;
    }
    radiance += brdfTimesCosine(underSun, n, v, params.toSun) * params.sunIrradiance * visibility;
    for (uint first = 0u; anyLamps != 0u && first < lampBlock.count; first += lampsPerLayer) {
        uvec4 bits = lampMaskAt(pixel, first / lampsPerLayer);
        while (bits != uvec4(0u)) {
            radiance += lampLight(first + popFirstLamp(bits), s, p, n, v, pixel, parts);
        }
    }
    return radiance;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.view.size)))) {
        IndirectParts parts;
        imageStore(direct, pixel, vec4(clampToHalf(radianceAt(pixel, parts)), 1.0));
        if ((anyEmitters | anyReflected) != 0u) {
            imageStore(fromEmitters, pixel, vec4(clampToHalf(parts.emitters), 1.0));
        }
        if (highlights != 0u) {
            imageStore(emitterHighlights, pixel, vec4(clampToHalf(parts.highlights), 1.0));
        }
    }
}
