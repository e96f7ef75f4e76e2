// One slice: its coordinates, the walk to both sides, and what is left open.
//
// Coordinates in a slice are (x, y): x in metres to the side of the walk, y toward the eye, from the point that is shaded.
// Directions are angles from the direction to the eye. Each side's directions, from the eye down to the horizon of the
// hemisphere, are split into 32 sectors of equal cosine-weighted share, a bit each. The sectors' limits are dithered, so
// that the share that bits cover is right on average.
//
// A slice that contains a cosine-distributed direction is chosen with the probability of its share of the hemisphere, so all
// slices count alike.
//
// The includer declares own (ViewParams of the image that is walked), and the constants sliceThickness and sliceLight;
// it defines SliceTexel loadSlice(ivec2 pixel) and bool coversFromBehind().
#ifndef REFLET_SLICE_GLSL
#define REFLET_SLICE_GLSL

#include "effects/lobe/slice.h"
#include "shaders/directional_light.glsl"
#include "shaders/luminance.glsl"
#include "shaders/projection.glsl"

const float quarterTurn = 1.57079632679;
const uint sectors = 32u;          // of a side
const float firstStep = 1.0;       // pixels
const float nearHorizon = 0.999;   // share of a side's directions above what may be the point's own plane
const float leastTurn = 0.05;      // sine of the smallest angle between normals of planes that meet in an edge
const float leastFacing = 0.02;    // smallest cosine to the view of a surface's normal

// A surface that the walk meets.
struct SliceTexel {
    float depth;  // reversed; 0: sky
    float thickness;  // metres, if sliceThickness is sliceThicknessLayer
    vec3 normal;      // geometric
    vec3 light;       // radiance toward the viewer, taken to be the same toward the point
};

SliceTexel loadSlice(ivec2 pixel);
bool coversFromBehind();

struct Slice {
    vec3 toEye;         // unit
    vec3 aside;         // unit, in the slice, perpendicular to toEye
    float eyeDistance;  // metres; 0: orthographic
    float normalAngle;  // of the normal in the slice, toward aside
    vec2 tangent;       // normal of the own tangent plane, (aside, toward the eye)
    vec2 step;          // pixels along the slice, unit length, toward aside
    vec2 depthSlope;    // change of depth per pixel on the point's own tangent plane
    vec2 perPixel;      // of points on that plane: (x, y) · w per pixel along the slice
    float perDepth;     // of points above it: y · w per depth
    vec3 w;             // at the point; per pixel; per depth
};

// Share of the slice's cosine-weighted directions between the eye and this angle, relative to all of it; the hemisphere's
// share is cos(normal) + normal · sin(normal).
float arcShare(float angle, float normal) {
    return 0.25 * (cos(normal) - cos(2.0 * angle - normal) + 2.0 * angle * sin(normal));
}

// n: shading normal; geometric: that of the depth buffer.
Slice sliceThrough(vec3 p, vec2 uv, float depth, vec3 n, vec3 geometric, vec3 direction) {
    Slice s;
    vec3 eye = own.eye.xyz - p * own.eye.w;
    float away = length(eye);
    s.toEye = eye / away;
    s.eyeDistance = own.eye.w > 0.0 ? away : 0.0;
    vec3 aside = direction - dot(direction, s.toEye) * s.toEye;
    s.aside = dot(aside, aside) > 1e-12 ? normalize(aside) : normalize(cross(s.toEye, s.toEye.zxy + vec3(0.1, 0.2, 0.3)));
    // Normal maps may face away from the eye.
    s.normalAngle = clamp(atan(dot(n, s.aside), dot(n, s.toEye)), -0.99 * quarterTurn, 0.99 * quarterTurn);
    s.tangent = vec2(dot(geometric, s.aside), max(dot(geometric, s.toEye), leastFacing));
    vec4 clip = own.worldToClip * vec4(p, 1.0);
    vec4 clipStep = own.worldToClip * vec4(s.aside, 0.0);
    vec2 moved = (clipStep.xy * clip.w - clip.xy * clipStep.w) * own.size;
    s.step = moved * inversesqrt(max(dot(moved, moved), 1e-30));
    vec4 plane = planeOnScreen(p, geometric, own.clipToWorld);
    float facing = plane.z < 0.0 ? min(plane.z, -1e-12) : max(plane.z, 1e-12);
    s.depthSlope = -plane.xy * own.pixel / facing;
    vec4 perPixel = own.clipToWorld * vec4(2.0 * s.step * own.pixel, dot(s.depthSlope, s.step), 0.0);
    vec3 alongPlane = perPixel.xyz - p * perPixel.w;
    s.perPixel = vec2(dot(alongPlane, s.aside), dot(alongPlane, s.toEye));
    vec4 perDepth = own.clipToWorld[2];
    s.perDepth = dot(perDepth.xyz - p * perDepth.w, s.toEye);
    float w = dot(vec4(uvToNdc(uv), depth, 1.0),
                  vec4(own.clipToWorld[0].w, own.clipToWorld[1].w, own.clipToWorld[2].w, own.clipToWorld[3].w));
    s.w = vec3(w, perPixel.w, perDepth.w);
    return s;
}

// What a walk to one side found.
struct SliceSide {
    uint covered;  // sectors; bit 0 is next to the eye
    uint behind;   // sectors that pass behind a visible surface
    float share;   // of the side in the slice's hemisphere
    vec4 light;    // radiance · share, distance · share
    vec4 turning;  // variation of that light with the normal (directional_light.glsl), of white light without sliceLight
};

uint sectorsBelow(uint end) { return end >= sectors ? 0xffffffffu : (1u << end) - 1u; }

// Pixels from the point to the image's edge.
float pixelsToEdge(vec2 from, vec2 step) {
    vec2 ahead = mix(from, own.size - from, greaterThan(step, vec2(0.0)));
    vec2 pixels = ahead / max(abs(step), vec2(1e-6));
    return min(pixels.x, pixels.y);
}

// The directions of a side, for shareAbove.
struct Arc {
    vec2 normal;  // in the slice, unit
    float scale;  // 1 / (2 arcShare of the edge)
};

// Arc cosine, with an error of 7e-5 (Abramowitz and Stegun, Handbook of Mathematical Functions, 1964, 4.4.45).
float fastAcos(float c) {
    float a = min(abs(c), 1.0);
    float angle = sqrt(1.0 - a) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - 0.0187293 * a)));
    return c < 0.0 ? 2.0 * quarterTurn - angle : angle;
}

// Share of a side's directions above that to a point: arcShare of its angle, over that of the edge. With the sine and cosine of
// the angle at hand, only its own value costs more than a few multiplications.
float shareAbove(vec2 q, Arc arc) {
    float r2 = max(dot(q, q), 1e-18);
    float bent = q.x * (q.x * arc.normal.y - q.y * arc.normal.x) / r2;
    float share = arc.scale * (bent + fastAcos(q.y * inversesqrt(r2)) * arc.normal.x);
    float beforeEye = q.x > 0.0 ? clamp(share, 0.0, 1.0) : 0.0;
    return q.x > 0.0 && dot(q, arc.normal) <= 0.0 ? 1.0 : beforeEye;
}

// Where the view ray at `pixels` along the slice meets the line through q with this normal.
vec2 onTangent(Slice s, float side, float pixels, vec2 q, vec2 n2) {
    vec2 ownTimesW = vec2(pixels * s.perPixel.x, side * pixels * s.perPixel.y);
    float w = s.w.x + side * pixels * s.w.y;  // negative above the own plane's horizon
    bool orthographic = s.eyeDistance == 0.0;
    vec2 start = orthographic ? ownTimesW / w : vec2(0.0, s.eyeDistance);
    vec2 along = orthographic ? vec2(0.0, -1.0) : ownTimesW - w * start;
    float rate = min(dot(n2, along), -1e-9 * abs(w));
    return start + max(dot(n2, q - start) / rate, 0.0) * along;
}

// A surface that a walk has met.
struct Met {
    vec2 place;
    vec2 normal;   // in the slice
    float pixels;  // from the point
    float above;   // share of the side's directions above it
    float radius;  // distance from the point [m]
    vec3 light;
    bool covers;   // near enough, and not sky
    bool sky;
};

// Between the directions of two places.
vec2 betweenPlaces(vec2 a, vec2 b) {
    return a * inversesqrt(max(dot(a, a), 1e-18)) + b * inversesqrt(max(dot(b, b), 1e-18));
}

// Covers the sectors between two shares of the side's directions, in which these places are, by this surface, if they are still
// open and it faces the point.
void coverBetween(inout SliceSide found, Slice s, float side, vec3 n, Met m, float a, vec2 placeA, float b, vec2 placeB,
                  float dither) {
    uint first = uint(min(a, b) * float(sectors) + dither);
    uint beyond = uint(max(a, b) * float(sectors) + dither);
    bool faces = coversFromBehind() || dot(m.normal, m.place) < 0.0;
    uint fresh = m.covers && faces ? sectorsBelow(beyond) & ~sectorsBelow(first) & ~found.covered : 0u;
    found.covered |= fresh;
    float share = found.share * float(bitCount(fresh)) / float(sectors);
    vec2 middle = sliceLight != 0u ? m.place : betweenPlaces(placeA, placeB);
    vec3 toward = (side * middle.x * s.aside + middle.y * s.toEye) * inversesqrt(max(dot(middle, middle), 1e-18));
    float light = 1.0;
    if (sliceLight != 0u) {
        found.light += share * vec4(m.light, m.radius);
        light = luminance(m.light);
    }
    found.turning += directionalFromRay(share * light, toward, n);
}

// Where two lines meet, each through a place with a normal; far away if they are parallel.
vec2 meetingOf(Met a, Met b) {
    float det = a.normal.x * b.normal.y - a.normal.y * b.normal.x;
    vec2 k = vec2(dot(a.normal, a.place), dot(b.normal, b.place));
    det = det < 0.0 ? min(det, -1e-6) : max(det, 1e-6);
    return vec2(k.x * b.normal.y - k.y * a.normal.y, a.normal.x * k.y - b.normal.x * k.x) / det;
}

// Where a surface starts in the directions of a side.
struct SliceStart {
    float above;  // share of the side's directions above it
    vec2 place;
};

// Covers what the first of two samples, one after the other along the walk, has of what lies between them, and returns where the
// second's surface starts. The surface goes on from one to the other if their tangent planes meet in between, which is
// then its edge, or are about the same. Else there is a gap, and each surface ends halfway (in the logarithm) on average.
SliceStart coverGap(inout SliceSide found, Slice s, float side, vec3 n, Met before, Met now, float root, SliceParams o,
                    Arc arc, float dither) {
    float atBefore = before.place.y - onTangent(s, side, before.pixels, now.place, now.normal).y;
    float here = onTangent(s, side, now.pixels, before.place, before.normal).y - now.place.y;
    float turn = before.normal.x * now.normal.y - before.normal.y * now.normal.x;
    float lengths2 = dot(before.normal, before.normal) * dot(now.normal, now.normal);
    bool meet = !now.sky && atBefore * here <= 0.0 && turn * turn > leastTurn * leastTurn * lengths2;
    bool same = min(abs(atBefore), abs(here)) <= 0.5 * o.thickness;
    vec2 corner = meetingOf(before, now);
    vec2 endBefore = meet ? corner : onTangent(s, side, before.pixels * root, before.place, before.normal);
    vec2 startNow = meet ? corner : onTangent(s, side, now.pixels / root, now.place, now.normal);
    bool goesOn = !now.sky && !meet && same;
    // All of it belongs to the surface whose plane passes nearer to the other's sample.
    bool byBefore = abs(here) < abs(atBefore);
    float joint = byBefore ? now.above : before.above;
    float end = goesOn ? joint : shareAbove(endBefore, arc);
    float start = goesOn ? joint : shareAbove(startNow, arc);
    vec2 jointPlace = byBefore ? now.place : before.place;
    coverBetween(found, s, side, n, before, before.above, before.place, end, goesOn ? jointPlace : endBefore, dither);
    return SliceStart(start, goesOn ? jointPlace : startNow);
}

// side: 1 or -1. shift: of the samples, in steps; dither: of the sectors' limits; both in [0, 1). n: shading normal.
SliceSide walkSide(Slice s, float side, ivec2 pixel, float depth, vec3 n, SliceParams o, float shift, float dither) {
    float normal = side * s.normalAngle;
    float whole = arcShare(normal + quarterTurn, normal);
    Arc arc = Arc(vec2(sin(normal), cos(normal)), 0.5 / whole);
    SliceSide found;
    found.covered = 0u;
    found.behind = 0u;
    found.share = whole / (arc.normal.y + normal * arc.normal.x);
    found.light = vec4(0.0);
    found.turning = vec4(0.0);
    vec2 origin = vec2(pixel) + 0.5;
    float pixelsPerMetre = s.w.x / max(s.perPixel.x, 1e-20);
    float last = min(pixelsToEdge(origin, side * s.step), o.radius * pixelsPerMetre);
    float growth = exp2(log2(max(last / firstStep, 1.0)) / float(o.steps));
    float root = sqrt(growth);
    float along = firstStep * pow(growth, shift);
    // The point itself covers nothing, but is where the first surface may go on.
    Met before = Met(vec2(0.0), vec2(side * s.tangent.x, s.tangent.y), 0.0, 1.0, 0.0, vec3(0.0), false, false);
    uint end = last < firstStep ? 0u : o.steps;
    bool endsInSky = true;
    for (uint i = 0u; i < end; ++i) {
        ivec2 at = clamp(ivec2(origin + side * along * s.step), ivec2(0), ivec2(own.size) - 1);
        along *= growth;
        SliceTexel texel = loadSlice(at);
        Met now;
        now.sky = texel.depth <= 0.0;
        vec2 away = vec2(at - pixel);
        now.pixels = side * dot(away, s.step);
        // Above the tangent plane. So surfaces do not cover themselves, wherever in its pixel the slice passes.
        float rise = texel.depth - (depth + dot(away, s.depthSlope));
        float w = now.sky ? s.w.x : s.w.x + side * now.pixels * s.w.y + rise * s.w.z;
        now.place = vec2(now.pixels * s.perPixel.x, side * now.pixels * s.perPixel.y + rise * s.perDepth) / w;
        now.radius = length(now.place);
        now.normal = vec2(side * dot(texel.normal, s.aside), max(dot(texel.normal, s.toEye), leastFacing));
        now.light = texel.light;
        now.above = shareAbove(now.place, arc);
        float faded = clamp((o.radius - now.radius) / max(o.falloff * o.radius, 1e-6), 0.0, 1.0);
        bool other = now.pixels > 0.4;
        bool solid = !now.sky && other;
        now.covers = solid && faded > dither;
        float thickness = sliceThickness == sliceThicknessLayer ? texel.thickness : o.thickness;
        thickness *= sliceThickness == sliceThicknessGrowing ? now.radius : 1.0;
        vec2 below = vec2(0.0, -1.0);
        if (s.eyeDistance > 0.0) {
            below = normalize(now.place - vec2(0.0, s.eyeDistance));
        }
        SliceStart start = SliceStart(now.above, now.place);
        // Between samples on the own plane there is nothing but its unevenness.
        if (other && (before.above < nearHorizon || solid && now.above < nearHorizon)) {
            start = coverGap(found, s, side, n, before, now, root, o, arc, dither);
        }
        vec2 back = now.place + thickness * below;
        float under = shareAbove(back, arc);
        found.behind |= now.covers ? ~sectorsBelow(uint(now.above * float(sectors) + dither)) : 0u;
        SliceStart top = SliceStart(now.above, now.place);
        SliceStart bottom = SliceStart(under, back);
        if (start.above < top.above) {
            top = start;
        }
        if (start.above > bottom.above) {
            bottom = start;
        }
        coverBetween(found, s, side, n, now, top.above, top.place, max(bottom.above, now.above), bottom.place, dither);
        if (solid) {
            before = now;
        }
        endsInSky = now.sky;
    }
    // Nothing is known from the last sample to the end: its surface goes on.
    if (!endsInSky && before.above < nearHorizon) {
        vec2 beyond = onTangent(s, side, max(last, before.pixels), before.place, before.normal);
        coverBetween(found, s, side, n, before, before.above, before.place, shareAbove(beyond, arc), beyond,
                     dither);
    }
    return found;
}

// Index of the unset bit with `rank` unset bits below it.
uint openSector(uint covered, uint rank) {
    uint open = ~covered;
    uint at = 0u;
    for (uint width = 16u; width > 0u; width >>= 1u) {
        uint below = bitCount(bitfieldExtract(open, int(at), int(width)));
        bool beyond = rank >= below;
        rank -= beyond ? below : 0u;
        at += beyond ? width : 0u;
    }
    return at;
}

// The angle above which this share of the side's directions lies.
float angleAt(float share, float normal) {
    float low = 0.0;
    float high = normal + quarterTurn;
    float wanted = share * arcShare(high, normal);
    for (int i = 0; i < 8; ++i) {
        float middle = 0.5 * (low + high);
        bool below = arcShare(middle, normal) < wanted;
        low = below ? middle : low;
        high = below ? high : middle;
    }
    return 0.5 * (low + high);
}

// What a slice leaves open.
struct SliceRest {
    float open;      // share of its directions
    vec3 direction;  // one of these, at random
    bool behind;     // that direction passes behind a visible surface
};

float openShare(SliceSide side) { return side.share * float(sectors - bitCount(side.covered)) / float(sectors); }

// u: random number in [0, 1).
SliceRest restOf(Slice s, SliceSide ahead, SliceSide back, float dither, float u) {
    float openAhead = openShare(ahead);
    SliceRest rest;
    rest.open = min(openAhead + openShare(back), 1.0);  // rounding
    float picked = u * rest.open;
    bool isAhead = picked < openAhead;
    picked -= isAhead ? 0.0 : openAhead;
    uint covered = isAhead ? ahead.covered : back.covered;
    float side = isAhead ? 1.0 : -1.0;
    float place = picked * float(sectors) / max(isAhead ? ahead.share : back.share, 1e-9);
    uint sector = min(openSector(covered, min(uint(place), sectors - 1u)), sectors - 1u);
    rest.behind = (((isAhead ? ahead.behind : back.behind) >> sector) & 1u) != 0u;
    float share = clamp((float(sector) + fract(place) - dither) / float(sectors), 0.0, 1.0);
    float angle = angleAt(share, side * s.normalAngle);
    rest.direction = cos(angle) * s.toEye + side * sin(angle) * s.aside;
    return rest;
}

#endif
