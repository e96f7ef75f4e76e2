// How much of the sun's disk each pixel sees, by PCF or PCSS. In: depth, geometric normal, shadow map and its ranges,
// blue noise. Out: visibility, 1 lit; width of the penumbra and mean height of the blockers.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/shadow/shadow.h"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint searchRanges = 1;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { ShadowVisibilityParams params; };
layout(set = 0, binding = 1) uniform sampler2D depth;
layout(set = 0, binding = 2) uniform usampler2D geometricNormal;
layout(set = 0, binding = 3) uniform sampler2D shadowMap;
layout(set = 0, binding = 4) uniform sampler2D range;
layout(set = 0, binding = 5, scalar) readonly buffer BlueNoise { uint texels[]; } blueNoise;
layout(set = 0, binding = 6, r8) uniform writeonly image2D visibility;
layout(set = 0, binding = 7, rg16f) uniform writeonly image2D penumbra;

uint loadBlueNoise(uint texel) { return blueNoise.texels[texel]; }
float loadShadowDepth(ivec2 texel) { return texelFetch(shadowMap, texel, 0).r; }
vec2 loadShadowRange(ivec2 cell) { return texelFetch(range, cell, 0).rg; }
#include "shaders/blue_noise.glsl"
#include "shaders/shadow_range.glsl"

const float leastFilterRadius = 0.75;  // texels: under it, the four around the point are all there is to know
const uint shadowStream = 0x5ad0u;   // of the noise

ShadowReceiver receiver;
ShadowTexel shadowTexel(vec2 offset) { return trustedTexel(receiver, offset); }
#include "shaders/soft_shadow.glsl"

// What the visibility image and the penumbra image get.
struct Result {
    float visibility;
    float width;
    float height;
};

// Noise of this pixel: two numbers for the filter and two for the search.
vec4 noiseAt(ivec2 pixel) {
    ViewParams view = params.view;
    if (params.settings.pattern == ShadowPattern_rings) {
        uint h = hashPixel(uvec2(pixel), view.seed, view.frame);
        return vec4(hashToUnit2(h), hashToUnit2(hashPcg(h)));
    }
    uvec2 at = uvec2(pixel);
    uint filterMask = loadBlueNoise(blueNoiseTexel(at, shadowStream + view.seed, view.frame));
    uint searchMask = loadBlueNoise(blueNoiseTexel(at, shadowStream + 1u + view.seed, view.frame));
    return vec4(filterMask & 0xffffu, filterMask >> 16u, searchMask & 0xffffu, searchMask >> 16u) / 65536.0;
}

// Share of the sun's disk above the plane of a surface that faces its middle with cosine `facing`.
float shareAboveHorizon(float facing, float sine) {
    float t = clamp(facing / max(sine, 1e-6), -1.0, 1.0);
    return 0.5 + (t * sqrt(1.0 - t * t) + asin(t)) / 3.14159265;
}

// Shrinks the search to what can cast from within it: nothing there is higher than the map's highest, and what is not
// higher hides the sun from no farther. True where the whole disk is hidden.
bool shrinkSearch(ShadowCone cone, float least, inout float radius) {
    for (int i = 0; i < 3 && radius > least; ++i) {
        vec2 heights = heightRange(receiver, radius);
        vec2 rise = abs(receiver.slope) * 2.0 * (radius * receiver.texelsPerMetre + 1.0) / vec2(receiver.size);
        if (heights.x > rise.x + rise.y + receiver.lift) {
            return true;
        }
        float needed = penumbraRadius(cone, heights.y);
        bool done = needed > 0.7 * radius;
        radius = min(radius, needed);
        if (done) {
            break;
        }
    }
    return false;
}

Result pcss(ShadowCone cone, vec4 noise) {
    ShadowSettings s = params.settings;
    float least = leastFilterRadius * params.map.texelSize;
    float radius = penumbraRadius(cone, (1.0 - receiver.s.z) * receiver.depthRange);
    if (searchRanges != 0u && shrinkSearch(cone, least, radius)) {
        return Result(0.0, 0.0, 0.0);
    }
    if (radius <= least) {
        return Result(sharpVisibility(receiver), 0.0, 0.0);
    }
    float height = meanBlockerHeight(cone, radius, least, receiver.lift, shadowPattern(s, s.blockerSamples, noise.zw),
                                     s.blockerSamples);
    if (height <= 0.0) {
        return Result(1.0, -2.0 * radius, 0.0);
    }
    float width = 2.0 * max(penumbraRadius(cone, height), least);
    float visible = diskVisibility(cone, height, least, receiver.lift, shadowPattern(s, s.samples, noise.xy), s.samples);
    return Result(visible, width, height);
}

Result pcf(vec4 noise) {
    ShadowSettings s = params.settings;
    float radius = s.radius * (s.radiusUnit == ShadowUnit_texels ? params.map.texelSize : 1.0);
    return Result(pcfVisibility(radius, receiver.lift, shadowPattern(s, s.samples, noise.xy), s.samples), 2.0 * radius,
                  0.0);
}

Result resultAt(ivec2 pixel) {
    float d = texelFetch(depth, pixel, 0).r;
    if (d <= 0.0) {
        return Result(1.0, 0.0, 0.0);
    }
    ShadowSettings s = params.settings;
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    vec3 n = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    ivec2 size = textureSize(shadowMap, 0);
    float share = 1.0;
    if (s.biasKind == ShadowBias_constant) {
        receiver = constantReceiver(p, params.map, size, s.constantBias);
    } else {
        float facing = dot(n, params.map.toSun);
        float sine = params.sunSlope * inversesqrt(1.0 + params.sunSlope * params.sunSlope);
        share = s.filter == ShadowFilter_pcss ? shareAboveHorizon(facing, sine) : facing > 0.0 ? 1.0 : 0.0;
        if (share <= 0.0) {
            return Result(0.0, 0.0, 0.0);
        }
        receiver = slopeReceiver(p, n, params.map, size, s.bias);
    }
    vec4 noise = noiseAt(pixel);
    Result r = s.filter == ShadowFilter_pcss ? pcss(ShadowCone(params.sunSlope, 0.0), noise) : pcf(noise);
    r.visibility *= share;
    return r;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.view.size)))) {
        Result r = resultAt(pixel);
        imageStore(visibility, pixel, vec4(r.visibility));
        imageStore(penumbra, pixel, vec4(clamp(vec2(r.width, r.height), -60000.0, 60000.0), 0.0, 0.0));
    }
}
