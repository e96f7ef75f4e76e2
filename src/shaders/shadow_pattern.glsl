// Sample points on the unit disk for shadow filters, one after another, rotated per pixel.
// Vogel: equal areas at the golden angle (Vogel, A Better Way to Construct the Sunflower Head, 1979). Rings: a spiral
// that is denser in the middle, often called a Poisson disk in course material: radius (i / count)^0.75 over some
// turns. Optionally every second point is the mirror image of the one before.
#ifndef REFLET_SHADOW_PATTERN_GLSL
#define REFLET_SHADOW_PATTERN_GLSL

#include "effects/shadow/shadow.h"

struct ShadowPattern {
    vec2 direction;  // of the next point
    vec2 turn;       // cosine and sine of the angle between points
    float part;      // fraction of the disk's area (Vogel) or of the spiral (rings) inside the next point
    float step;      // added to `part` for each point
    bool rings;
    bool mirrored;
    bool again;  // the next point is the last one, mirrored
    vec2 last;
};

vec2 rotated(vec2 v, vec2 by) { return vec2(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x); }

// noise: two numbers in [0, 1): the rotation of the pattern and, for Vogel, the radial offset of a point within its
// ring.
ShadowPattern shadowPattern(ShadowSettings settings, uint count, vec2 noise) {
    const float goldenAngle = 2.39996323;
    ShadowPattern p;
    p.rings = settings.pattern == ShadowPattern_rings;
    p.mirrored = p.rings && settings.mirrored != 0u;
    uint points = p.mirrored ? (count + 1u) / 2u : count;
    p.step = 1.0 / float(points);
    p.part = p.step * (p.rings ? 1.0 : noise.y);
    float angle = p.rings ? 6.28318531 * settings.rings * p.step : goldenAngle;
    p.turn = vec2(cos(angle), sin(angle));
    p.direction = vec2(cos(6.28318531 * noise.x), sin(6.28318531 * noise.x));
    p.again = false;
    p.last = vec2(0.0);
    return p;
}

vec2 nextPoint(inout ShadowPattern p) {
    if (p.again) {
        p.again = false;
        return -p.last.yx;
    }
    float radius = sqrt(p.part);
    p.last = p.direction * (p.rings ? radius * sqrt(radius) : radius);
    p.direction = rotated(p.direction, p.turn);
    p.part += p.step;
    p.again = p.mirrored;
    return p.last;
}

#endif
