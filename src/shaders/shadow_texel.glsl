// What a look-up in a shadow map tells, and how heights become penumbras.
#ifndef REFLET_SHADOW_TEXEL_GLSL
#define REFLET_SHADOW_TEXEL_GLSL

struct ShadowTexel {
    float height;     // metres above the receiver's point, toward the light, of what the map holds
    float clearance;  // metres above the receiver's own plane, toward the light; outside the map: far below
    bool known;       // the map holds the receiver's surface there, or something above it. If not, the texel's centre
                      // lies past the surface's edge, and may see the light that goes past a wall that shadows all of it
};

// The directions from a receiver to all of a light's disk.
struct ShadowCone {
    float slope;    // radius over distance; the sun: tan(angular diameter / 2)
    float inverse;  // 1 / distance of the light [1/m]; the sun: 0
};

// By similar triangles: how far from the receiver, across the light, what is `height` metres above it can be and still
// hide a part of the disk; as the map sees it, from the light's middle.
float penumbraRadius(ShadowCone cone, float height) {
    return max(height, 0.0) * cone.slope / max(1.0 - height * cone.inverse, 1e-3);
}

#endif
