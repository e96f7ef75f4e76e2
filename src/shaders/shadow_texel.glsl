// The result of a shadow-map look-up, and penumbra radii from blocker heights.
#ifndef REFLET_SHADOW_TEXEL_GLSL
#define REFLET_SHADOW_TEXEL_GLSL

struct ShadowTexel {
    float height;     // of the stored surface above the receiver, toward the light [m]
    float clearance;  // of the stored surface above the receiver's plane, toward the light [m]; -1e9: outside
    bool known;       // the texel holds the receiver's surface or something above it. If not, its centre lies beyond the
                      // surface's edge, and may see light that passes a wall which shadows the whole surface
};

// Clearances up to which a texel leaves its receiver lit [m].
struct DepthBias {
    float most;  // texels with more block; covers curvature, creases and rounding
    float own;   // texels with at most this hold the receiver's own surface; covers rounding
};

const float ownShare = 0.125;  // of DepthBias.most

bool blocks(ShadowTexel texel, DepthBias bias) { return texel.clearance > bias.most; }

// Whether the light reaches the receiver's own surface at the texel's centre. A point is lit only if it does so nearby:
// where another surface meets the receiver's in a crease, its clearance is less than any bias, but the receiver's own
// surface is nowhere to be seen (priority buffer: Hourcade and Nicolas, Algorithms for Antialiased Cast Shadows, 1985,
// which compares identities instead of depths).
bool showsReceiver(ShadowTexel texel, DepthBias bias) { return texel.known && texel.clearance <= bias.own; }

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
