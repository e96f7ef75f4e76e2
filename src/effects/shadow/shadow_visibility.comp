// Visible fraction of the sun's disk per pixel, by shadow map (hard, PCF, PCSS). In: depth, geometric normal, shadow
// maps and their ranges, blue noise.
// Out: visibility, 1 lit; with soft filters also the penumbra width and the mean height of the blockers; with cascades,
// the cascade used.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/shadow/shadow.h"
#include "shaders/cascades.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint filterKind = ShadowFilter_pcss;
layout(constant_id = 1) const uint hasRanges = 1;
layout(constant_id = 2) const uint cascades = 1;
layout(constant_id = 3) const uint biasKind = ShadowBias_slope;
layout(scalar) uniform ParamsBlock { ShadowVisibilityParams params; };
uniform sampler2D depth;
uniform usampler2D geometricNormal;
uniform sampler2D shadowMap;
uniform sampler2D range;
layout(scalar) readonly buffer BlueNoise { uint texels[]; } blueNoise;
layout(r8) uniform writeonly image2D visibility;
layout(rg16f) uniform writeonly image2D penumbra;
layout(r8) uniform writeonly image2D cascadeIndex;

uint loadBlueNoise(uint texel) { return blueNoise.texels[texel]; }
float loadShadowDepth(ivec2 texel) { return texelFetch(shadowMap, texel, 0).r; }
vec2 loadShadowRange(ivec2 cell) { return texelFetch(range, cell, 0).rg; }
#include "shaders/shadow_noise.glsl"
#include "shaders/shadow_range.glsl"

const uint sunStream = 0x5ad0u;        // of the noise

ShadowReceiver receiver;
ShadowTexel shadowTexel(vec2 offset) { return texelAt(receiver, offset); }
// Once for all that may ask for it: CPU devices execute the code of all branches.
float hardLight;
float hardShadow() { return hardLight; }
#include "shaders/soft_shadow.glsl"

// Bilinear filter over four texels: the sharpest edge that the map's resolution allows.
float sharpVisibility(bool needed) {
    int taps = needed ? 4 : 0;  // dynamic on purpose: see hardVisibility (shadow_map.glsl)
    vec2 f = fract(receiver.at - 0.5);
    vec2 low = -f / receiver.texelsPerMetre;
    vec2 high = (1.0 - f) / receiver.texelsPerMetre;
    LitSum sum = LitSum(0.0, 0.0, 0u, false);
    for (int i = 0; i < taps; ++i) {
        vec2 offset = mix(low, high, bvec2((i & 1) != 0, i > 1));
        vec2 share = mix(1.0 - f, f, bvec2((i & 1) != 0, i > 1));
        ShadowTexel texel = shadowTexel(offset);
        addTexel(sum, texel, receiver.bias, !blocks(texel, receiver.bias), share.x * share.y);
    }
    return litFraction(sum, false);
}

// Values for the visibility and penumbra images.
struct Result {
    float visibility;
    float width;
    float height;
};

// Shrinks the blocker search radius to the penumbra radius of the highest depth within it, by the min/max pyramid. True
// if the whole disk is occluded.
bool shrinkSearch(ShadowCone cone, float least, inout float radius) {
    for (int i = 0; i < 3 && radius > least; ++i) {
        vec2 heights = heightRange(receiver, textureSize(shadowMap, 0), radius);
        vec2 rise = abs(receiver.slope) * 2.0 * (radius * receiver.texelsPerMetre + 1.0) / vec2(receiver.tile.size);
        if (heights.x > rise.x + rise.y + receiver.bias.most) {
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

Result pcss(ShadowCone cone, float texelSize, vec4 noise) {
    ShadowSettings s = params.settings;
    float least = minFilterRadius * texelSize;
    float radius = penumbraRadius(cone, (1.0 - receiver.s.z) * receiver.depthRange);
    if (hasRanges != 0u && shrinkSearch(cone, least, radius)) {
        return Result(0.0, 0.0, 0.0);
    }
    float sharp = sharpVisibility(radius <= least);
    if (radius <= least) {
        return Result(sharp, 0.0, 0.0);
    }
    float height = meanBlockerHeight(cone, radius, least, receiver.bias,
                                     shadowPattern(s, s.blockerSamples, noise.zw), s.blockerSamples);
    if (height < 0.0) {
        return Result(hardShadow(), 0.0, 0.0);
    }
    if (height == 0.0) {
        return Result(1.0, -2.0 * radius, 0.0);
    }
    float width = 2.0 * max(penumbraRadius(cone, height), least);
    float visible =
        diskVisibility(cone, height, least, receiver.bias, shadowPattern(s, s.samples, noise.xy), s.samples);
    return Result(visible, width, height);
}

Result pcf(float texelSize, vec4 noise) {
    ShadowSettings s = params.settings;
    float radius = s.radius * (s.radiusUnit == ShadowUnit_texels ? texelSize : 1.0);
    DepthBias bias = receiver.bias;
    bias.most *= 1.0 + 0.1 * radius / texelSize;  // the bias grows with the filter
    float visible = pcfVisibility(radius, bias, shadowPattern(s, s.samples, noise.xy), s.samples);
    return Result(visible, 2.0 * radius, 0.0);
}

// The share of the sun's disk above the surface's horizon.
float shareOfNormal(vec3 normal, vec3 toSun) {
    float facing = dot(normal, toSun);
    float sine = params.sunSlope * inversesqrt(1.0 + params.sunSlope * params.sunSlope);
    return filterKind == ShadowFilter_pcss ? fractionAboveHorizon(facing, sine) : facing > 0.0 ? 1.0 : 0.0;
}

Result resultIn(uint cascade, vec3 p, vec3 normal, vec4 noise) {
    ShadowSettings s = params.settings;
    ShadowMapParams map = params.sun.maps[cascade];
    ShadowTile tile = ShadowTile(cascadeTileOrigin(cascade, s.resolution), ivec2(s.resolution));
    receiver = biasKind == ShadowBias_constant ? constantReceiver(p, map, tile, s.constantBias)
                                                 : slopeReceiver(p, normal, map, tile, s.bias);
    hardLight = hardVisibility(receiver);
    if (filterKind == ShadowFilter_hard) {
        return Result(hardLight, 0.0, 0.0);
    }
    return filterKind == ShadowFilter_pcss ? pcss(ShadowCone(params.sunSlope, 0.0), map.texelSize, noise)
                                           : pcf(map.texelSize, noise);
}

Result mixed(Result a, Result b, float share) {
    return Result(mix(a.visibility, b.visibility, share), mix(a.width, b.width, share), mix(a.height, b.height, share));
}

Result resultAt(vec3 p, Cascade cascade, ivec2 pixel) {
    vec3 normal = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    float share = biasKind == ShadowBias_constant ? 1.0 : shareOfNormal(normal, params.sun.maps[0].toSun);
    if (filterKind == ShadowFilter_none || share <= 0.0) {
        return Result(filterKind == ShadowFilter_none ? 1.0 : 0.0, 0.0, 0.0);
    }
    bool rings = params.settings.pattern == ShadowPattern_rings;
    vec4 noise = filterKind == ShadowFilter_hard ? vec4(0.0) : shadowNoise(pixel, params.view, rings, sunStream);
    Result r = resultIn(cascade.index, p, normal, noise);
    if (cascades > 1u && cascade.next > 0.0) {
        r = mixed(r, resultIn(cascade.index + 1u, p, normal, noise), cascade.next);
    }
    r.visibility *= share;
    return r;
}

void look(ivec2 pixel) {
    float d = texelFetch(depth, pixel, 0).r;
    Result r = Result(1.0, 0.0, 0.0);                 // for the sky
    Cascade c = Cascade(cascades - 1u, 0.0);
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        if (cascades > 1u) {  // with a non-constant index CPU devices process lanes one by one
            c = selectCascade(dot(params.view.viewPlane, vec4(p, 1.0)), params.sun);
        }
        r = resultAt(p, c, pixel);
    }
    imageStore(visibility, pixel, vec4(r.visibility));
    if (filterKind == ShadowFilter_pcf || filterKind == ShadowFilter_pcss) {
        imageStore(penumbra, pixel, vec4(clamp(vec2(r.width, r.height), -60000.0, 60000.0), 0.0, 0.0));
    }
    if (cascades > 1u) {
        imageStore(cascadeIndex, pixel, vec4((float(c.index) + c.next) / float(maxCascades - 1u)));
    }
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.view.size)))) {
        look(pixel);
    }
}
