// Looking up an orthographic shadow map with reversed depth (1 nearest to the sun).
// The includer defines, before it includes this: float loadShadowDepth(ivec2 texel).
#ifndef REFLET_SHADOW_MAP_GLSL
#define REFLET_SHADOW_MAP_GLSL

#include "render/shadow/shadow.h"
#include "shaders/shadow_texel.glsl"

const float leastFacing = 0.05;     // cosine under which a surface is followed as if it were this
const float edgeLift = 0.75;        // part of the lift that is left out at edges
const float bentAway = 2.0;         // metres that a surface may bend away from its plane by for each to the side
const float outsideTheMap = -1e9;   // clearance

// Where a map lies in the image that several share.
struct ShadowTile {
    ivec2 origin;
    ivec2 size;
};

// A receiver in a map.
struct ShadowReceiver {
    vec3 s;             // in shadow space
    vec2 at;            // the same in texels of the map
    vec2 texelsPerMetre;
    vec2 aside;         // texels: unit, the way that its surface faces, across the sun; 0: straight at the sun
    vec2 slope;         // metres toward the sun that its plane rises by for each unit along x and y of shadow space
    float depthRange;   // metres
    ShadowTile tile;
    float lift;         // metres toward the sun under which nothing blocks: curvature, creases and rounding
    bool ownPlane;      // its surface is followed along its own plane
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
    r.aside = vec2(0.0);
    r.slope = vec2(0.0);
    r.depthRange = map.depthRange;
    r.tile = tile;
    r.lift = 0.0;
    r.ownPlane = false;
    return r;
}

// A surface is followed along its own plane to the centre of the texel that is looked up, for there the map holds its
// depth: planes never shadow themselves, however far to the side a filter looks. Then `bias`, texels along the normal.
ShadowReceiver slopeReceiver(vec3 p, vec3 normal, ShadowMapParams map, ShadowTile tile, float bias) {
    ShadowReceiver r = receiverAt(p, map, tile);
    float facing = dot(normal, map.toSun);
    // The normal in shadow space's own axes: depth changes by -n.xy / n.z for each step along x and y.
    vec3 axisX = shadowAxis(map, 0);
    vec3 axisY = shadowAxis(map, 1);
    vec2 sideways = vec2(dot(normal, axisX), dot(normal, axisY));
    r.aside = dot(sideways, sideways) > 1e-6 * dot(axisX, axisX) ? normalize(sideways) : vec2(0.0);
    r.slope = -sideways / vec2(dot(axisX, axisX), dot(axisY, axisY)) / max(facing, leastFacing);
    r.lift = bias * map.texelSize / max(facing, leastFacing);
    r.ownPlane = true;
    return r;
}

// The point's own depth, `bias` metres nearer to the sun (Williams, Casting curved shadows on curved surfaces, 1978). A
// surface whose depth changes by more than that from the texel's centre to its corner shadows itself; casters that are
// nearer than that to what they shadow are missed.
ShadowReceiver constantReceiver(vec3 p, ShadowMapParams map, ShadowTile tile, float bias) {
    ShadowReceiver r = receiverAt(p, map, tile);
    r.lift = bias;
    return r;
}

// offset: metres across the sun, along the map's axes. What the map does not hold cannot cast.
ShadowTexel texelAt(ShadowReceiver r, vec2 offset) {
    ivec2 texel = ivec2(floor(r.at + offset * r.texelsPerMetre));
    if (outsideMap(texel, r.tile.size)) {
        return ShadowTexel(outsideTheMap, outsideTheMap, !r.ownPlane);
    }
    vec2 toCentre = (2.0 * (vec2(texel) + 0.5) / vec2(r.tile.size) - 1.0) - r.s.xy;
    float depth = loadShadowDepth(r.tile.origin + texel);
    float height = (depth - r.s.z) * r.depthRange;
    float clearance = height - dot(r.slope, toCentre);
    // Depth 0: nothing lies there.
    return ShadowTexel(height, clearance, !r.ownPlane || (depth > 0.0 && clearance >= -r.lift - bentAway * length(offset)));
}

// The texel that the receiver is in; where it does not know the surface, what hides most of the others around and of one
// that lies farther to the side that the surface faces. Near its edges a surface casts on itself by less than `lift`.
ShadowTexel trustedTexel(ShadowReceiver r) {
    ShadowTexel texel = texelAt(r, vec2(0.0));
    // A count that is not known before: CPUs leave such a loop where none of a group's pixels needs more, and would
    // always run all of one that can be unrolled.
    int others = texel.known ? 0 : 4;
    vec2 next = sign(fract(r.at) - 0.5) / r.texelsPerMetre;
    const float aside = 1.5;  // texels
    for (int i = 0; i < others; ++i) {
        vec2 offset = i == 3 ? aside * r.aside / r.texelsPerMetre : next * vec2((i & 1) == 0 ? 1.0 : 0.0, i > 0 ? 1.0 : 0.0);
        ShadowTexel other = texelAt(r, offset);
        if (other.clearance > texel.clearance) {
            texel = other;
        }
    }
    texel.clearance += others > 0 ? edgeLift * r.lift : 0.0;
    return texel;
}

// 1: lit. A hard edge, exact to the texel.
float hardVisibility(ShadowReceiver r) { return trustedTexel(r).clearance > r.lift ? 0.0 : 1.0; }

#endif
