// The sun's visibility from a point by a shadow map: hard, PCF, PCSS. The includer declares params
// (ShadowVisibilityParams, or what has its `settings`, `sun` and `sunSlope`), the image shadowMap, the constants
// filterKind, hasRanges, cascades and biasKind, and what shadow_map.glsl and shadow_range.glsl need. It may define
// NOTE_TEXEL(offset, texel), for each look-up.
#ifndef REFLET_SUN_SHADOW_GLSL
#define REFLET_SUN_SHADOW_GLSL

#include "shaders/cascades.glsl"
#include "shaders/shadow_range.glsl"

ShadowReceiver receiver;
#ifndef NOTE_TEXEL
#define NOTE_TEXEL(offset, texel)
#endif
ShadowTexel shadowTexel(vec2 offset) {
    ShadowTexel texel = texelAt(receiver, offset);
    NOTE_TEXEL(offset, texel);
    return texel;
}
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
        vec2 heights = heightRange(receiver, shadowAtlasSize(), radius);
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

float roundingAt(vec3 p) {
    return roundingOfPixel(p, pixelWidth(p, params.view.viewPlane, params.view.eye, params.view.pixelAngle));
}

Result resultIn(uint cascade, vec3 p, vec3 normal, vec4 noise) {
    ShadowSettings s = params.settings;
    ShadowMapParams map = params.sun.maps[cascade];
    ShadowTile tile = ShadowTile(cascadeTileOrigin(cascade, s.resolution), ivec2(s.resolution));
    receiver = biasKind == ShadowBias_constant ? constantReceiver(p, map, tile, s.constantBias)
                                                 : slopeReceiver(p, normal, map, tile, s.bias, roundingAt(p));
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

#endif
