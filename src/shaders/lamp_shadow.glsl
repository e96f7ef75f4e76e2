// Looking up a lamp's shadow maps: perspective tiles with reversed depth, near / distance along the tile's axis. What
// shadow_map.glsl is for the sun, with the lines of light going out from a point.
// The includer defines, before it includes this: float loadLampDepth(ivec2 texel), of the atlas.
#ifndef REFLET_LAMP_SHADOW_GLSL
#define REFLET_LAMP_SHADOW_GLSL

#include "render/shadow/lamp_shadow.h"
#include "shaders/shadow_texel.glsl"

// A point that a lamp may light, as its shadow maps see it. World space, metres.
struct LampReceiver {
    LampShadow shadow;
    uint tileSize;   // texels
    uint columns;    // of tiles in the atlas
    vec3 fromLamp;   // the point
    vec3 normal;     // of its plane
    vec3 toLamp;     // unit
    vec3 acrossX;    // unit, across the way to the lamp: axes of look-ups to the side
    vec3 acrossY;
    vec3 aside;      // the way that the plane faces, across the way to the lamp: unit, or 0 where it faces the lamp
    float distance;  // of the lamp
    float facing;    // cosine between normal and toLamp, not under leastLampFacing
    float texel;     // metres that a texel of the map spans here
    float lift;      // metres toward the lamp under which nothing blocks: curvature, creases and rounding
};

const float leastLampFacing = 0.05;
const ShadowTexel noLampTexel = ShadowTexel(-1e9, -1e9, true);  // what the map does not hold cannot cast

uint tileFace(LampShadow shadow, vec3 fromLamp) {
    if (shadow.tiles == 1u) {
        return 0u;
    }
    vec3 a = abs(fromLamp);
    uint axis = a.x >= a.y && a.x >= a.z ? 0u : a.y >= a.z ? 1u : 2u;
    return 2u * axis + (fromLamp[axis] < 0.0 ? 1u : 0u);
}

vec3 intoTile(LampShadow shadow, uint face, vec3 v) {
    if (shadow.tiles == 1u) {
        return shadow.worldToTile * v;
    }
    uint axis = face / 2u;
    return vec3(v[(axis + 1u) % 3u], v[(axis + 2u) % 3u], face % 2u == 0u ? v[axis] : -v[axis]);
}

// bias: texels along the normal.
LampReceiver lampReceiver(LampShadow shadow, uint tileSize, uint columns, vec3 p, vec3 normal, float bias) {
    LampReceiver r;
    r.shadow = shadow;
    r.tileSize = tileSize;
    r.columns = columns;
    r.fromLamp = p - shadow.lamp.position;
    r.normal = normal;
    r.distance = max(length(r.fromLamp), 1e-6);
    r.toLamp = -r.fromLamp / r.distance;
    r.acrossX = normalize(cross(abs(r.toLamp.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), r.toLamp));
    r.acrossY = cross(r.toLamp, r.acrossX);
    float facing = dot(normal, r.toLamp);
    vec3 sideways = normal - facing * r.toLamp;
    float across = length(sideways);
    r.aside = across > 1e-3 ? sideways / across : vec3(0.0);
    r.facing = max(facing, leastLampFacing);
    float along = intoTile(shadow, tileFace(shadow, r.fromLamp), r.fromLamp).z;
    r.texel = 2.0 * shadow.halfTangent / float(tileSize) * along;
    r.lift = bias * r.texel / r.facing;
    return r;
}

// Where a line from the lamp meets the lamp's tiles.
struct TilePlace {
    uint face;
    vec2 at;  // texels of the tile
    bool inside;
};

TilePlace tilePlace(LampReceiver r, vec3 fromLamp) {
    TilePlace place;
    place.face = tileFace(r.shadow, fromLamp);
    vec3 v = intoTile(r.shadow, place.face, fromLamp);
    place.at = (0.5 + 0.5 * v.xy / (v.z * r.shadow.halfTangent)) * float(r.tileSize);
    place.inside = v.z > 0.0 && all(greaterThanEqual(place.at, vec2(0.0))) &&
                   all(lessThanEqual(place.at, vec2(r.tileSize)));
    return place;
}

vec3 besides(LampReceiver r, vec2 offset) { return r.fromLamp + offset.x * r.acrossX + offset.y * r.acrossY; }

// A texel of a tile, one in the tile next to its edge for one outside. aside: how far from the receiver the line
// through its centre may pass [m].
ShadowTexel tileTexel(LampReceiver r, uint face, ivec2 texel, float aside) {
    texel = clamp(texel, ivec2(0), ivec2(r.tileSize) - 1);
    uint tile = r.shadow.firstTile + face;
    float depth = loadLampDepth(ivec2(tile % r.columns, tile / r.columns) * int(r.tileSize) + texel);
    if (depth <= 0.0) {
        return noLampTexel;
    }
    // The map holds what lies on the line through the texel's centre; it is compared with the receiver's plane there.
    vec2 centre = (2.0 * (vec2(texel) + 0.5) / float(r.tileSize) - 1.0) * r.shadow.halfTangent;
    vec3 held = vec3(centre, 1.0) * (r.shadow.near / depth);
    float height = r.distance + dot(held, intoTile(r.shadow, face, r.toLamp));
    float above = dot(held - intoTile(r.shadow, face, r.fromLamp), intoTile(r.shadow, face, r.normal));
    // What is farther from the lamp than the receiver may be above its plane, too: where that is seen at a grazing angle,
    // the next wall. It hides nothing, unless it comes nearer, steeper than 1 : 4, on the way from there to the receiver.
    const float steepest = 4.0;
    return ShadowTexel(height, min(above / r.facing, height + steepest * aside), true);
}

// What the lamp's light is compared with that passes the receiver by `offset` metres. Where a texel's centre sees neither
// the receiver's plane nor anything above it, the centre lies past the surface's edge, and may see the light that goes
// past a wall which shadows all of it: then what hides most of the texels around is taken, and where they do not know
// better, one that lies farther to the side that the surface faces.
ShadowTexel lampTexel(LampReceiver r, vec2 offset) {
    TilePlace place = tilePlace(r, besides(r, offset));
    if (!place.inside) {
        return noLampTexel;
    }
    float aside = length(offset) + 1.5 * r.texel;
    ivec2 middle = ivec2(floor(place.at));
    ShadowTexel texel = tileTexel(r, place.face, middle, aside);
    if (texel.clearance >= -r.lift) {
        return texel;
    }
    ivec2 next = ivec2(sign(fract(place.at) - 0.5));
    ivec2 others[3] = ivec2[](ivec2(next.x, 0), ivec2(0, next.y), next);
    for (int i = 0; i < 3; ++i) {
        ShadowTexel other = tileTexel(r, place.face, middle + others[i], aside);
        if (other.clearance > texel.clearance) {
            texel = other;
        }
    }
    if (texel.clearance < -r.lift) {
        place = tilePlace(r, besides(r, offset) + 1.5 * r.texel * r.aside);
        ShadowTexel other = tileTexel(r, place.face, ivec2(floor(place.at)), aside + 1.5 * r.texel);
        if (place.inside && other.clearance > texel.clearance) {
            texel = other;
        }
    }
    return texel;
}

// 1: lit. A hard edge, exact to the texel.
float hardLampVisibility(LampReceiver r) { return lampTexel(r, vec2(0.0)).clearance > r.lift ? 0.0 : 1.0; }

// Four texels around the point, weighted by how near they are: an edge as sharp as the map allows.
float sharpLampVisibility(LampReceiver r) {
    TilePlace place = tilePlace(r, r.fromLamp);
    vec2 low = floor(place.at - 0.5);
    vec2 f = place.at - 0.5 - low;
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ShadowTexel texel = tileTexel(r, place.face, ivec2(low) + corner, 1.5 * r.texel);
        if (texel.clearance >= -r.lift) {
            vec2 weight = mix(1.0 - f, f, vec2(corner));
            sum += weight.x * weight.y * vec2(texel.clearance > r.lift ? 0.0 : 1.0, 1.0);
        }
    }
    return sum.y > 0.0 ? sum.x / sum.y : hardLampVisibility(r);
}

#endif
