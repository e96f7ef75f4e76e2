// Shadow-map filtering over a disk: with a constant radius (PCF: Reeves, Salesin and Cook, Rendering Antialiased
// Shadows with Depth Maps, 1987), or with a radius from the size of the light and the mean blocker height (PCSS:
// Fernando, Percentage-Closer Soft Shadows, 2005). Works for any light with a shadow map.
// The includer defines, before it includes this: ShadowTexel shadowTexel(vec2 offset), the look-up for the light ray
// that passes the receiver at `offset` metres; and float hardShadow(), the receiver's visibility with a hard edge.
#ifndef REFLET_SOFT_SHADOW_GLSL
#define REFLET_SOFT_SHADOW_GLSL

#include "shaders/shadow_pattern.glsl"
#include "shaders/shadow_texel.glsl"

const float minFilterRadius = 0.75;  // texels; a smaller disk stays within the four texels around the point

// Fraction of the light's disk above the horizon of a surface that faces its centre with cosine `facing`. sine: of the
// disk's angular radius.
float fractionAboveHorizon(float facing, float sine) {
    float t = clamp(facing / max(sine, 1e-6), -1.0, 1.0);
    return 0.5 + (t * sqrt(1.0 - t * t) + asin(t)) / 3.14159265;
}

// Accumulated look-ups.
struct LitSum {
    float lit;  // weight of lit texels
    float all;  // weight of all texels
    uint own;   // number of texels that show the receiver's own surface
    bool near;  // a texel shows it, or it bent away from the light
};

void addTexel(inout LitSum sum, ShadowTexel texel, DepthBias bias, bool lit, float weight) {
    sum.lit += lit ? weight : 0.0;
    sum.all += weight;
    sum.own += showsReceiver(texel, bias) ? 1u : 0u;
    sum.near = sum.near || (texel.clearance <= bias.own && texel.clearance >= -bias.most);
}

// Texels a little above the receiver's surface and those beyond its edge count as lit, unless they are in truth a wall
// and the outside of it: then neither they nor the texels next to the receiver show its surface, but for one by chance.
// tall: what blocks is far above the receiver, not in a crease; then the surface may be bent away from the light.
float litFraction(LitSum sum, bool tall) {
    return sum.own > 1u || (tall && sum.near) || (sum.lit > 0.0 && hardShadow() > 0.0) ? sum.lit / sum.all : 0.0;
}

float pcfVisibility(float radius, DepthBias bias, ShadowPattern pattern, uint count) {
    LitSum sum = LitSum(0.0, 0.0, 0u, false);
    for (uint i = 0u; i < count; ++i) {
        ShadowTexel texel = shadowTexel(radius * nextPoint(pattern));
        addTexel(sum, texel, bias, !blocks(texel, bias), 1.0);
    }
    return litFraction(sum, false);
}

// Mean height of the blockers within `radius`; 0: none found; -1: nor the receiver's own surface in the texel that holds
// it. A blocker to the side counts only if it is high enough to cover a part of the light as seen from the receiver: lower ones cast their
// shadows elsewhere and would bias the mean. The weight is how much of the light a blocker hides: one over the square
// of its own penumbra radius, or of the spacing of the samples if that is larger. least: half width that the map
// resolves [m].
float meanBlockerHeight(ShadowCone cone, float radius, float least, DepthBias bias, ShadowPattern pattern,
                        uint count) {
    float spacing = max(radius * inversesqrt(float(count)), least);
    vec2 sum = vec2(0.0);
    bool own = false;
    for (uint i = 0u; i <= count; ++i) {
        vec2 offset = i == 0u ? vec2(0.0) : radius * nextPoint(pattern);
        ShadowTexel texel = shadowTexel(offset);
        float reach = max(penumbraRadius(cone, texel.height), spacing);
        if (blocks(texel, bias) && length(offset) <= reach) {
            sum += vec2(max(texel.height, 0.0), 1.0) / (reach * reach);
        }
        own = own || (i == 0u && showsReceiver(texel, bias));
    }
    return sum.y > 0.0 ? max(sum.x / sum.y, 1e-4) : own ? 0.0 : -1.0;
}

// Fraction of the light's disk that is visible, if all blockers are at `height`. Texels that rise less
// steeply than `steep` are the receiver's own surroundings and do not block.
float diskVisibility(ShadowCone cone, float height, float least, DepthBias bias, ShadowPattern pattern, uint count) {
    const float steep = 1.0;
    float radius = max(penumbraRadius(cone, height), least);
    LitSum sum = LitSum(0.0, 0.0, 0u, false);
    for (uint i = 0u; i < count; ++i) {
        vec2 point = nextPoint(pattern);
        ShadowTexel texel = shadowTexel(radius * point);
        bool before = texel.height >= steep * radius * length(point);
        addTexel(sum, texel, bias, !(blocks(texel, bias) && before), 1.0);
    }
    return litFraction(sum, radius > least);
}

#endif
