// Look-ups in the shadow maps of lamps: perspective tiles with reversed depth, near / distance along the tile's axis, and
// nested orthographic tiles of directional lamps, with reversed linear depth.
// Does what shadow_map.glsl does for the sun, also with light rays that diverge from a point.
// The includer defines, before it includes this: float loadLampDepth(ivec2 texel), of the atlas.
#ifndef REFLET_LAMP_SHADOW_GLSL
#define REFLET_LAMP_SHADOW_GLSL

#include "effects/shadow/lamp_shadow.h"
#include "shaders/shadow_texel.glsl"

// CPU devices execute the code of all branches.
layout(constant_id = 52) const uint anyDistant = 1u;  // directional lamps

// A shading point relative to a lamp and its shadow maps. World space, metres.
struct LampReceiver {
    LampShadow shadow;
    uint tileSize;  // texels of the lamp's tiles
    uint cell;      // texels from tile to tile
    uint columns;   // of tiles in the atlas
    uint finest;    // directional: of the nested tiles that the point's look-ups read
    vec3 fromLamp;  // from the lamp (directional: from LampShadow::lamp.position) to the point
    vec3 normal;    // of the point's plane
    vec3 toLamp;    // unit
    vec3 acrossX;   // unit, perpendicular to the light ray: axes of filter offsets
    vec3 acrossY;
    vec3 tiltDirection;  // unit, the normal projected across the light ray; 0 where the plane faces the lamp
    float distance;      // to the lamp; directional: to the near plane of its tiles
    float facing;        // cosine between normal and toLamp, at least minLampFacing
    float texel;         // size of a texel of the map at the receiver [m]
    DepthBias bias;
};

const float minLampFacing = 0.05;
const ShadowTexel noLampTexel = ShadowTexel(-1e9, -1e9);  // nothing outside the map casts shadows

bool isDistant(LampShadow shadow) { return anyDistant != 0u && shadow.lamp.type == lampDirectional; }

// Half the width of a nested tile [m].
float nestedHalf(LampShadow shadow, uint tile) { return shadow.halfTangent / float(1u << tile); }

vec2 nestedMiddle(LampShadow shadow, uint tile) {
    return tile == 0u ? vec2(0.0) : tile == 1u ? shadow.middle1 : tile == 2u ? shadow.middle2 : shadow.middle3;
}

// The finest nested tile, up to `finest`, that contains a square of half the width `around` about a point. A square that
// is large compared with a tile need not lie in it entirely. Each tile lies within the one before.
uint nestedTile(LampShadow shadow, vec2 at, float around, uint finest) {
    vec3 halves = shadow.halfTangent * vec3(0.5, 0.25, 0.125);
    vec2 from1 = abs(at - shadow.middle1);
    vec2 from2 = abs(at - shadow.middle2);
    vec2 from3 = abs(at - shadow.middle3);
    vec3 outermost = vec3(max(from1.x, from1.y), max(from2.x, from2.y), max(from3.x, from3.y));
    bvec3 inside = lessThanEqual(outermost + min(vec3(around), 0.5 * halves), halves);
    return min(inside.z ? 3u : inside.y ? 2u : inside.x ? 1u : 0u, finest);
}

uint tileFace(LampShadow shadow, vec3 fromLamp) {
    if (shadow.tiles == 1u) {
        return 0u;
    }
    vec3 a = abs(fromLamp);
    uint axis = a.x >= a.y && a.x >= a.z ? 0u : a.y >= a.z ? 1u : 2u;
    return 2u * axis + (fromLamp[axis] < 0.0 ? 1u : 0u);
}

vec3 toTileSpace(LampShadow shadow, uint face, vec3 v) {
    if (shadow.tiles != cubeFaces) {
        return shadow.worldToTile * v;
    }
    uint axis = face / 2u;
    return vec3(v[(axis + 1u) % 3u], v[(axis + 2u) % 3u], face % 2u == 0u ? v[axis] : -v[axis]);
}

// Turns a receiver of a directional lamp toward that and chooses its tile. around: how far from the receiver's light ray
// filters may read [m].
void makeDistant(inout LampReceiver r, float around) {
    vec3 v = r.shadow.worldToTile * r.fromLamp;
    r.distance = max(v.z, 1e-6);
    r.toLamp = r.shadow.lamp.toLamp;
    float spare = 2.0 * r.shadow.halfTangent / float(r.tileSize);  // a texel of the first tile, eight of the finest
    r.finest = nestedTile(r.shadow, v.xy, max(around, spare), nestedTiles - 1u);
}

// tileSize: texels from tile to tile; bias: in texels, along the normal; around: of makeDistant.
LampReceiver lampReceiver(LampShadow shadow, uint tileSize, uint columns, vec3 p, vec3 normal, float bias,
                          float rounding, float around) {
    LampReceiver r;
    r.shadow = shadow;
    r.tileSize = shadow.side > 0u ? shadow.side : tileSize;
    r.cell = tileSize;
    r.columns = columns;
    r.fromLamp = p - shadow.lamp.position;
    r.normal = normal;
    r.distance = max(length(r.fromLamp), 1e-6);
    r.toLamp = -r.fromLamp / r.distance;
    r.finest = 0u;
    if (isDistant(shadow)) {
        makeDistant(r, around);
    }
    r.acrossX = normalize(cross(abs(r.toLamp.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), r.toLamp));
    r.acrossY = cross(r.toLamp, r.acrossX);
    float facing = dot(normal, r.toLamp);
    vec3 sideways = normal - facing * r.toLamp;
    float across = length(sideways);
    r.tiltDirection = across > 1e-3 ? sideways / across : vec3(0.0);
    r.facing = max(facing, minLampFacing);
    float along = toTileSpace(shadow, tileFace(shadow, r.fromLamp), r.fromLamp).z;
    r.texel = 2.0 / float(r.tileSize) *
              (isDistant(shadow) ? nestedHalf(shadow, r.finest) : shadow.halfTangent * along);
    r.bias = planeBias(bias * r.texel, r.facing, rounding / r.facing);
    return r;
}

// Position of a light ray on the lamp's tiles.
struct TileCoord {
    uint face;
    vec2 at;  // texels in the tile
    bool inside;
};

TileCoord tileCoord(LampReceiver r, vec3 fromLamp) {
    TileCoord coord;
    coord.face = tileFace(r.shadow, fromLamp);
    vec3 v = toTileSpace(r.shadow, coord.face, fromLamp);
    vec2 across = v.xy / (v.z * r.shadow.halfTangent);
    bool before = v.z > 0.0;
    if (isDistant(r.shadow)) {
        coord.face = nestedTile(r.shadow, v.xy, 0.0, r.finest);
        across = (v.xy - nestedMiddle(r.shadow, coord.face)) / nestedHalf(r.shadow, coord.face);
        before = true;
    }
    coord.at = (0.5 + 0.5 * across) * float(r.tileSize);
    coord.inside = before && all(greaterThanEqual(coord.at, vec2(0.0))) &&
                   all(lessThanEqual(coord.at, vec2(r.tileSize)));
    return coord;
}

vec3 shiftedPoint(LampReceiver r, vec2 offset) { return r.fromLamp + offset.x * r.acrossX + offset.y * r.acrossY; }

// A texel of a tile, clamped to the tile's edge. aside: how far from the receiver the ray through its centre may pass
// [m].
ShadowTexel tileTexel(LampReceiver r, uint face, ivec2 texel, float aside) {
    texel = clamp(texel, ivec2(0), ivec2(r.tileSize) - 1);
    uint tile = r.shadow.firstTile + face;
    float depth = loadLampDepth(ivec2(tile % r.columns, tile / r.columns) * int(r.cell) + texel);
    if (depth <= 0.0) {
        return noLampTexel;
    }
    // The stored depth is that of the ray through the texel's centre, so it is compared with the receiver's plane
    // there.
    vec2 centre = 2.0 * (vec2(texel) + 0.5) / float(r.tileSize) - 1.0;
    vec3 held = vec3(centre * r.shadow.halfTangent, 1.0) * (r.shadow.near / depth);
    if (isDistant(r.shadow)) {
        held = vec3(centre * nestedHalf(r.shadow, face) + nestedMiddle(r.shadow, face), (1.0 - depth) * r.shadow.near);
    }
    float height = r.distance + dot(held, toTileSpace(r.shadow, face, r.toLamp));
    float above = dot(held - toTileSpace(r.shadow, face, r.fromLamp), toTileSpace(r.shadow, face, r.normal));
    // Something farther from the lamp than the receiver can still be above its plane: at grazing angles, the next wall.
    // It does not block if it is more than 4 metres farther per metre to the side.
    const float steepest = 4.0;
    return ShadowTexel(height, min(above / r.facing, max(height + steepest * aside, r.bias.most)));
}

// For a light ray `offset` metres beside the receiver. If the texel's centre sees neither the receiver's plane nor
// anything above it, the centre lies beyond the edge of the surface, and may see light that passes a wall which shadows
// the whole surface. Then the texel around it that occludes most is taken instead, and if none of them knows the
// surface either, one that lies farther in the tilt direction of the surface.
ShadowTexel lampTexel(LampReceiver r, vec2 offset) {
    TileCoord coord = tileCoord(r, shiftedPoint(r, offset));
    if (!coord.inside) {
        return noLampTexel;
    }
    float aside = length(offset) + 1.5 * r.texel;
    ivec2 middle = ivec2(floor(coord.at));
    ShadowTexel texel = tileTexel(r, coord.face, middle, aside);
    if (texel.clearance >= -r.bias.most) {
        return texel;
    }
    ivec2 next = ivec2(sign(fract(coord.at) - 0.5));
    ivec2 others[3] = ivec2[](ivec2(next.x, 0), ivec2(0, next.y), next);
    for (int i = 0; i < 3; ++i) {
        ShadowTexel other = tileTexel(r, coord.face, middle + others[i], aside);
        if (other.clearance > texel.clearance) {
            texel = other;
        }
    }
    if (texel.clearance < -r.bias.most) {
        coord = tileCoord(r, shiftedPoint(r, offset) + 1.5 * r.texel * r.tiltDirection);
        ShadowTexel other = tileTexel(r, coord.face, ivec2(floor(coord.at)), aside + 1.5 * r.texel);
        if (coord.inside && other.clearance > texel.clearance) {
            texel = other;
        }
    }
    return texel;
}

// Visibility with a hard edge, exact to the texel; 1: lit. Decides as hardVisibility of shadow_map.glsl does.
float hardLampVisibility(LampReceiver r) {
    ShadowTexel texel = lampTexel(r, vec2(0.0));
    bool own = texel.clearance <= r.bias.own;
    bool bent = true;
    int others = own || blocks(texel, r.bias) ? 0 : 4;
    TileCoord coord = tileCoord(r, r.fromLamp);
    ivec2 next = ivec2(sign(fract(coord.at) - 0.5));
    for (int i = 0; i < others; ++i) {
        ivec2 at = ivec2(floor(coord.at)) + next * ivec2(i & 1, i >> 1);
        ShadowTexel other = tileTexel(r, coord.face, at, 1.5 * r.texel);
        own = own || showsReceiver(other, r.bias);
        bent = bent && isNear(other, r.bias);
    }
    return own || (others > 0 && bent) ? 1.0 : 0.0;
}

// Bilinear filter of the four texels around the point: as sharp an edge as the map allows.
float sharpLampVisibility(LampReceiver r) {
    TileCoord coord = tileCoord(r, r.fromLamp);
    vec2 low = floor(coord.at - 0.5);
    vec2 f = coord.at - 0.5 - low;
    vec2 sum = vec2(0.0);
    uint own = 0u;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ShadowTexel texel = tileTexel(r, coord.face, ivec2(low) + corner, 1.5 * r.texel);
        own += showsReceiver(texel, r.bias) ? 1u : 0u;
        if (texel.clearance >= -r.bias.most) {
            vec2 weight = mix(1.0 - f, f, vec2(corner));
            sum += weight.x * weight.y * vec2(blocks(texel, r.bias) ? 0.0 : 1.0, 1.0);
        }
    }
    float hard = own > 1u ? 1.0 : hardLampVisibility(r);
    return sum.y > 0.0 ? min(hard, sum.x / sum.y) : hard;
}

#endif
