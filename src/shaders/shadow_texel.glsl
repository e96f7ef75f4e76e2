// The result of a shadow-map look-up, and penumbra radii from blocker heights.
#ifndef REFLET_SHADOW_TEXEL_GLSL
#define REFLET_SHADOW_TEXEL_GLSL

struct ShadowTexel {
    float height;     // of the stored surface above the receiver, toward the light [m]
    float clearance;  // of the stored surface above the receiver's plane, toward the light [m]; -1e9: outside
    bool known;       // the texel holds the receiver's surface or something above it. If not, its centre lies beyond the
                      // surface's edge, and may see light that passes a wall which shadows the whole surface
};

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
