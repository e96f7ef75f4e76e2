// Light culling: whether the range and the cone of a lamp reach a tile of the screen between two depths. Conservative:
// false positives only cost time, false negatives do not occur.
#ifndef REFLET_LAMP_REACH_GLSL
#define REFLET_LAMP_REACH_GLSL

#include "effects/lamps.h"
#include "effects/view.h"
#include "shaders/projection.glsl"

// The part of the view frustum inside all planes and the sphere. World space.
struct TileBounds {
    vec4 sides[4];  // dot(side, (p, 1)): metres from the side, positive inside the tile
    vec3 center;    // of a bounding sphere
    float radius;
    vec2 distances;  // nearest and farthest view distance
};

// uvMin, uvMax: upper left and lower right corner. depths: of the nearest and the farthest surface. Works for any
// projection: the space between two depths is the hull of its eight corners.
TileBounds tileBounds(vec2 uvMin, vec2 uvMax, vec2 depths, ViewParams view) {
    TileBounds tile;
    mat4 rows = transpose(view.worldToClip);
    vec2 low = uvToNdc(uvMin);
    vec2 high = uvToNdc(uvMax);
    tile.sides = vec4[4](rows[0] - low.x * rows[3], high.x * rows[3] - rows[0], rows[1] - low.y * rows[3],
                         high.y * rows[3] - rows[1]);
    for (int i = 0; i < 4; ++i) {
        tile.sides[i] /= length(tile.sides[i].xyz);
    }
    vec3 corners[8];
    tile.center = vec3(0.0);
    for (int i = 0; i < 8; ++i) {
        vec2 uv = vec2((i & 1) == 0 ? uvMin.x : uvMax.x, (i & 2) == 0 ? uvMin.y : uvMax.y);
        corners[i] = uvToWorld(uv, (i & 4) == 0 ? depths.x : depths.y, view.clipToWorld);
        tile.center += 0.125 * corners[i];
        float distance = dot(view.viewPlane, vec4(corners[i], 1.0));
        tile.distances = i == 0 ? vec2(distance) : vec2(min(tile.distances.x, distance), max(tile.distances.y, distance));
    }
    float square = 0.0;
    for (int i = 0; i < 8; ++i) {
        vec3 d = corners[i] - tile.center;
        square = max(square, dot(d, d));
    }
    tile.radius = sqrt(square);
    return tile;
}

bool rangeReaches(vec3 position, float range, TileBounds tile, vec4 viewPlane) {
    vec3 d = tile.center - position;
    float together = range + tile.radius;
    float distance = dot(viewPlane, vec4(position, 1.0));
    bool reaches = dot(d, d) <= together * together && distance + range >= tile.distances.x &&
                   distance - range <= tile.distances.y;
    for (int i = 0; i < 4; ++i) {
        reaches = reaches && dot(tile.sides[i], vec4(position, 1.0)) >= -range;
    }
    return reaches;
}

// Cones of at most 90 degrees from the axis. The sphere is outside if it is farther from the cone's lateral surface
// than its radius; behind the apex that distance is underestimated, which is conservative.
bool coneReaches(LampParams lamp, vec3 center, float radius) {
    vec3 d = center - lamp.position;
    float along = -dot(d, lamp.toLamp);
    float across = sqrt(max(dot(d, d) - along * along, 0.0));
    float cosine = lamp.cosOuter - 1e-4;  // margin for the rounding of the lamp's fall-off
    float sine = sqrt(clamp(1.0 - cosine * cosine, 0.0, 1.0));
    return across * cosine - along * sine <= radius && along >= -radius;
}

bool lampReaches(LampParams lamp, TileBounds tile, vec4 viewPlane) {
    if (lamp.type == lampDirectional) {
        return true;
    }
    // Rounding error of positions in floats.
    float slack = 1e-5 * (length(tile.center) + tile.radius + abs(tile.distances.y) + length(lamp.position));
    if (lamp.inverseRange > 0.0 && !rangeReaches(lamp.position, 1.0 / lamp.inverseRange + slack, tile, viewPlane)) {
        return false;
    }
    return (lamp.type != lampSpot && lamp.type != lampReflected) || coneReaches(lamp, tile.center, tile.radius + slack);
}

#endif
