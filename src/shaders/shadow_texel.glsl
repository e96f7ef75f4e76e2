// The result of a shadow-map look-up, and penumbra radii from blocker heights.
#ifndef REFLET_SHADOW_TEXEL_GLSL
#define REFLET_SHADOW_TEXEL_GLSL

#include "shaders/subpixel.glsl"

struct ShadowTexel {
    float height;     // of the stored surface above the receiver, toward the light [m]
    float clearance;  // of the stored surface above the receiver's plane, toward the light [m]; -1e9: none is stored
};

// Clearances by which texels are told apart [m].
struct DepthBias {
    float most;   // above: another surface, which blocks; covers curvature, creases and rounding
    float own;    // up to this: the receiver's own surface; covers rounding
    float below;  // down to minus this, too
};

const float edgeShare = 0.125; // of DepthBias.most: what counts of it beyond the edge of a surface

// Lower clamp of the cosine between normal and light by which the bias grows. At grazing light it would reach across the
// folds of the receiver's own surface, which then seem bent where they block.
const float leastBiasFacing = 0.1;

// Bias of a receiver whose plane is known. width: of the bias along the normal [m]; rounding: of positions [m], along the
// light.
DepthBias planeBias(float width, float facing, float rounding) {
    float most = width / max(facing, leastBiasFacing);
    float own = min(max(most / 32.0, rounding), most);
    return DepthBias(most, own, own);
}

// Rounding of a position in world space [m].
float rounding(vec3 p) { return 1e-6 * max(max(abs(p.x), abs(p.y)), abs(p.z)); }

// The same of a position from the depth of a pixel that is `width` metres wide: as a rule, not at worst, since what
// counts as the receiver's own surface cannot shadow it.
float roundingOfPixel(vec3 p, float width) { return max(rounding(p), 0.5 * subpixel * width); }

bool blocks(ShadowTexel texel, DepthBias bias) { return texel.clearance > bias.most; }

// Whether the light reaches the receiver's own surface at the texel's centre. Where it does so in no texel nearby, a
// surface that does not block may be a wall that meets the receiver's in a crease, or lie outside of it. (Hourcade and
// Nicolas, Algorithms for Antialiased Cast Shadows, 1985, compare the identities of surfaces to the same end.)
bool showsReceiver(ShadowTexel texel, DepthBias bias) {
    return texel.clearance <= bias.own && texel.clearance >= -bias.below;
}

// Whether the texel may show the receiver's own surface, bent.
bool isNear(ShadowTexel texel, DepthBias bias) { return abs(texel.clearance) <= bias.most; }

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
