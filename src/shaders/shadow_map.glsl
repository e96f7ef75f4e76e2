// Look-ups in an orthographic shadow map with reversed depth (1 nearest to the sun).
// The includer defines, before it includes this: float loadShadowDepth(ivec2 texel).
#ifndef REFLET_SHADOW_MAP_GLSL
#define REFLET_SHADOW_MAP_GLSL

#include "effects/shadow/shadow.h"
#include "shaders/shadow_texel.glsl"

const float minFacing = 0.01;         // lower clamp of the cosine between normal and sun
const float outsideClearance = -1e9;  // clearance outside the map and of empty texels

// Position of a map in the image that several maps share.
struct ShadowTile {
    ivec2 origin;
    ivec2 size;
};

// A receiver in the space of a map.
struct ShadowReceiver {
    vec3 s;   // in shadow space
    vec2 at;  // the same in texels of the map
    vec2 texelsPerMetre;
    vec2 tiltDirection;  // texels: unit, the normal projected across the sun's direction; 0: faces the sun
    vec2 slope;          // metres toward the sun by which the plane rises per unit of x and y in shadow space
    float depthRange;    // metres
    ShadowTile tile;
    DepthBias bias;
};

bool outsideMap(ivec2 texel, ivec2 size) {
    return any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size));
}

vec3 shadowAxis(ShadowMapParams map, int axis) {
    return vec3(map.worldToShadow[0][axis], map.worldToShadow[1][axis], map.worldToShadow[2][axis]);
}

ShadowReceiver receiverAt(vec3 p, ShadowMapParams map, ShadowTile tile) {
    ShadowReceiver r;
    r.s = (map.worldToShadow * vec4(p, 1.0)).xyz;
    r.at = (0.5 + 0.5 * r.s.xy) * vec2(tile.size);
    r.texelsPerMetre = 0.5 * vec2(tile.size) * vec2(length(shadowAxis(map, 0)), length(shadowAxis(map, 1)));
    r.tiltDirection = vec2(0.0);
    r.slope = vec2(0.0);
    r.depthRange = map.depthRange;
    r.tile = tile;
    r.bias = DepthBias(0.0, 0.0, 0.0);
    return r;
}

// Receiver-plane depth bias: the depth to compare against is that of the receiver's plane at the centre of the texel
// that is looked up, because the map holds the depth there. So planes never shadow themselves, however wide the filter
// is. `bias`, in texels along the normal, comes on top. rounding: of p [m].
ShadowReceiver slopeReceiver(vec3 p, vec3 normal, ShadowMapParams map, ShadowTile tile, float bias, float rounding) {
    ShadowReceiver r = receiverAt(p, map, tile);
    float facing = dot(normal, map.toSun);
    // The normal along the axes of shadow space: depth changes by -n.xy / n.z per step along x and y.
    vec3 axisX = shadowAxis(map, 0);
    vec3 axisY = shadowAxis(map, 1);
    vec2 sideways = vec2(dot(normal, axisX), dot(normal, axisY));
    r.tiltDirection = dot(sideways, sideways) > 1e-6 * dot(axisX, axisX) ? normalize(sideways) : vec2(0.0);
    r.slope = -sideways / vec2(dot(axisX, axisX), dot(axisY, axisY)) / max(facing, minFacing);
    // Below minFacing, the slope is not that of the plane.
    r.bias = planeBias(bias * map.texelSize, facing, facing < minFacing ? bias * map.texelSize / minFacing : rounding / facing);
    return r;
}

// Constant depth bias: the point's own depth, `bias` metres nearer to the sun (Williams, Casting Curved Shadows on
// Curved Surfaces, 1978). A surface whose depth changes by more than that between a texel's centre and its corner
// shadows itself; casters closer than that to the receiver are missed.
ShadowReceiver constantReceiver(vec3 p, ShadowMapParams map, ShadowTile tile, float bias) {
    ShadowReceiver r = receiverAt(p, map, tile);
    r.bias = DepthBias(bias, bias, -outsideClearance);
    return r;
}

// offset: metres across the sun's direction, along the map's axes. Nothing outside the map casts shadows.
ShadowTexel texelAt(ShadowReceiver r, vec2 offset) {
    ivec2 texel = ivec2(floor(r.at + offset * r.texelsPerMetre));
    if (outsideMap(texel, r.tile.size)) {
        return ShadowTexel(outsideClearance, outsideClearance);
    }
    vec2 toCentre = (2.0 * (vec2(texel) + 0.5) / vec2(r.tile.size) - 1.0) - r.s.xy;
    float depth = loadShadowDepth(r.tile.origin + texel);
    float height = (depth - r.s.z) * r.depthRange;
    return ShadowTexel(height, depth != 0.0 ? height - dot(r.slope, toCentre) : outsideClearance);
}

// Visibility with a hard edge, exact to the texel; 1: lit. If the texel that holds the receiver leaves it in doubt, four
// more decide, the three nearest ones and one farther in the tilt direction. A texel a little above or below the
// receiver's plane is the surface itself, bent, if the nearest ones are so, too, or if one shows the surface; else it is
// a wall that meets it in a crease. Instead of a texel beyond the surface's edge, the one that occludes most is taken.
float hardVisibility(ShadowReceiver r) {
    ShadowTexel texel = texelAt(r, vec2(0.0));
    bool own = showsReceiver(texel, r.bias);
    bool bent = isNear(texel, r.bias);
    float clearance = texel.clearance;
    // The trip count is dynamic on purpose: CPU drivers leave such a loop as soon as no pixel of the group needs more
    // iterations, but always run all iterations of a loop that can be unrolled.
    int others = own || blocks(texel, r.bias) ? 0 : 4;
    bool near = own || bent;
    vec2 next = sign(fract(r.at) - 0.5) / r.texelsPerMetre;
    const float aside = 1.5;  // texels
    for (int i = 0; i < others; ++i) {
        vec2 offset = i == 3 ? aside * r.tiltDirection / r.texelsPerMetre
                             : next * vec2((i & 1) == 0 ? 1.0 : 0.0, i > 0 ? 1.0 : 0.0);
        ShadowTexel other = texelAt(r, offset);
        own = own || showsReceiver(other, r.bias);
        bent = bent && (i == 3 || isNear(other, r.bias));
        clearance = max(clearance, other.clearance);
    }
    float highest = near ? r.bias.own : edgeShare * r.bias.most;
    return (near && own) || bent || clearance <= highest ? 1.0 : 0.0;
}

#endif
