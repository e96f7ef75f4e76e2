// Shadows filtered over a disk: of constant radius (PCF: Reeves, Salesin and Cook, Rendering antialiased shadows with
// depth maps, 1987), or of the radius that the light's size and the blockers' mean height give (PCSS: Fernando,
// Percentage-closer soft shadows, 2005). For any light that a map can be looked up for:
// The includer defines, before it includes this: ShadowTexel shadowTexel(vec2 offset), the map where the line toward
// the light lies that passes the receiver by `offset` metres.
#ifndef REFLET_SOFT_SHADOW_GLSL
#define REFLET_SOFT_SHADOW_GLSL

#include "shaders/shadow_pattern.glsl"
#include "shaders/shadow_texel.glsl"

const float leastFilterRadius = 0.75;  // texels: under it, the four around the point are all there is to know

// What is nearer to the receiver's plane than `lift` metres (toward the light) does not block.
bool blocks(ShadowTexel texel, float lift) { return texel.clearance > lift; }

// Share of the light's disk above the plane of a surface that faces its middle with cosine `facing`.
float shareAboveHorizon(float facing, float sine) {
    float t = clamp(facing / max(sine, 1e-6), -1.0, 1.0);
    return 0.5 + (t * sqrt(1.0 - t * t) + asin(t)) / 3.14159265;
}

// What look-ups found so far.
struct LitSum {
    float lit;       // of all, by weight
    float all;
    float knownLit;  // of those that know the surface
    float known;
};

void addTexel(inout LitSum sum, bool lit, bool known, float weight) {
    sum.lit += lit ? weight : 0.0;
    sum.all += weight;
    sum.knownLit += lit && known ? weight : 0.0;
    sum.known += known ? weight : 0.0;
}

// What is past a surface's edges is lit as long as some of the surface is. Where all that is known is in shadow, light
// that goes past is that outside of a wall, and must not come in. -1: nothing is known.
float litShare(LitSum sum) { return sum.known <= 0.0 ? -1.0 : sum.knownLit <= 0.0 ? 0.0 : sum.lit / sum.all; }

float pcfVisibility(float radius, float lift, ShadowPattern pattern, uint count) {
    LitSum sum = LitSum(0.0, 0.0, 0.0, 0.0);
    for (uint i = 0u; i < count; ++i) {
        ShadowTexel texel = shadowTexel(radius * nextPoint(pattern));
        addTexel(sum, !blocks(texel, lift), texel.known, 1.0);
    }
    return litShare(sum);
}

// Mean height of what hides a part of the light, as far as the search finds it within `radius`; 0: nothing. Of what
// lies to the side, only that counts which is high enough to be before the light as the receiver sees it: other
// blockers throw their shadows elsewhere, and would pull the mean down. Each counts by how much of the light it hides: by
// one over the square of its own penumbra, or of what lies between samples. least: the half width that the map resolves
// [m].
float meanBlockerHeight(ShadowCone cone, float radius, float least, float lift, ShadowPattern pattern, uint count) {
    float spacing = max(radius * inversesqrt(float(count)), least);
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i <= count; ++i) {
        vec2 offset = i == 0u ? vec2(0.0) : radius * nextPoint(pattern);
        ShadowTexel texel = shadowTexel(offset);
        float reach = max(penumbraRadius(cone, texel.height), spacing);
        if (blocks(texel, lift) && length(offset) <= reach) {
            sum += vec2(max(texel.height, 0.0), 1.0) / (reach * reach);
        }
    }
    return sum.y > 0.0 ? max(sum.x / sum.y, 1e-4) : 0.0;
}

// Share of the light's disk that what lies in the map leaves free, if all of it is at `height`; -1: unknown. What
// rises no more steeply than `steep` is the receiver's own surroundings, which face the sun.
float diskVisibility(ShadowCone cone, float height, float least, float lift, ShadowPattern pattern, uint count) {
    const float steep = 1.0;
    float radius = max(penumbraRadius(cone, height), least);
    LitSum sum = LitSum(0.0, 0.0, 0.0, 0.0);
    for (uint i = 0u; i < count; ++i) {
        vec2 point = nextPoint(pattern);
        ShadowTexel texel = shadowTexel(radius * point);
        bool before = texel.height >= steep * radius * length(point);
        addTexel(sum, !(blocks(texel, lift) && before), texel.known, 1.0);
    }
    return litShare(sum);
}

#endif
