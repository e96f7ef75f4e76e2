// The result of a shadow-map look-up, and penumbra radii from blocker heights.
#ifndef REFLET_SHADOW_TEXEL_GLSL
#define REFLET_SHADOW_TEXEL_GLSL

struct ShadowTexel {
    float height;     // of the stored surface above the receiver, toward the light [m]
    float clearance;  // of the stored surface above the receiver's plane, toward the light [m]; -1e9: none is stored
};

// Clearances by which texels are told apart [m].
struct DepthBias {
    float most;   // above: another surface, which blocks; covers curvature, creases and rounding
    float own;    // up to this: the receiver's own surface; covers rounding
    float below;  // down to minus this; farther below: the texel's centre lies beyond the surface's edge
};

// Bias of a receiver whose plane is known.
DepthBias planeBias(float most) { return DepthBias(most, 0.125 * most, 0.125 * most); }

bool blocks(ShadowTexel texel, DepthBias bias) { return texel.clearance > bias.most; }

// Whether the light reaches the receiver's own surface at the texel's centre. Where it does so in no texel nearby, a
// surface that does not block is a wall that meets the receiver's in a crease, or lies outside of it. (Hourcade and
// Nicolas, Algorithms for Antialiased Cast Shadows, 1985, compare the identities of surfaces to the same end.)
bool showsReceiver(ShadowTexel texel, DepthBias bias) {
    return texel.clearance <= bias.own && texel.clearance >= -bias.below;
}

// The cone of directions from a receiver to a disk light.
struct ShadowCone {
    float slope;    // radius / distance of the light; the sun: tan(angular diameter / 2)
    float inverse;  // 1 / distance of the light [1/m]; the sun: 0
};

// By similar triangles: the largest lateral distance from the receiver, across the light, at which a blocker `height`
// metres above it still covers a part of the disk, as seen from the light's centre.
float penumbraRadius(ShadowCone cone, float height) {
    return max(height, 0.0) * cone.slope / max(1.0 - height * cone.inverse, 1e-3);
}

#endif
