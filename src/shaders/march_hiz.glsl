// Hierarchical depth: cells that a ray passes wholly in front of, or wholly behind by more than the thickness, are left
// in one step, and the next larger ones are tried; else the next smaller. (Uludag, Hi-Z Screen-Space Cone-Traced
// Reflections, GPU Pro 5, 2014, with nearest and farthest depth)
// The includer defines, before it includes this, also: vec2 loadCell(ivec2 cell, int level): the largest (nearest)
// reversed depth and the smallest (farthest, of back faces where those are used) of the 2^level x 2^level pixels from
// cell · 2^level on, the latter negative where some show the sky, which does not count itself (0 and -1 where there is
// nothing else); level is at least 1.
#ifndef REFLET_MARCH_HIZ_GLSL
#define REFLET_MARCH_HIZ_GLSL

#include "shaders/march_pixels.glsl"

// Whether the cell's pixels must be looked at: the ray, between two distances, is neither wholly in front of all that
// they show nor wholly behind it. lost: set if it is behind; where some show the sky, only the pixels tell whether it is.
bool mustLookInto(vec2 depths, MarchRay ray, float first, float last, MarchOptions o, MarchView view, inout bool lost) {
    float awayFirst = ray.awayStart + first * ray.awayStep;
    float awayLast = ray.awayStart + last * ray.awayStep;
    if (isInFrontOf(max(awayFirst, awayLast), depths.x, view)) {
        return false;
    }
    if (isInFrontOf(min(awayFirst, awayLast) - o.thickness, abs(depths.y), view) || (depths.y < 0.0 && !lost)) {
        return true;
    }
    lost = true;
    return false;
}

// Finds the pixel that marchExhaustive finds.
MarchResult marchHiz(MarchRay ray, MarchOptions o, MarchView view) {
    ScreenRay r = makeScreenRay(ray, o.longest, view);
    ivec2 lastPixel = ivec2(view.size) - 1;
    ivec2 pixel = clamp(ivec2(floor(r.start.xy)), ivec2(0), lastPixel);
    ivec2 direction = ivec2(sign(r.delta.xy));
    MarchResult result = startOfMarch();
    float first = 0.0;
    int level = 0;
    for (uint i = 0u; i < o.maxSteps; ++i) {
        // The cell's far border.
        ivec2 cell = pixel >> level;
        ivec2 corner = (cell + max(direction, ivec2(0))) << level;
        vec2 s = bordersAt(r, corner);
        float sLast = min(min(s.x, s.y), 1.0);
        float last = metresAt(r, sLast);
        result.pixel = pixel;
        result.steps = i + 1u;
        if (level > 0 && mustLookInto(loadCell(cell, level), ray, first, last, o, view, result.lost)) {
            --level;
            continue;
        }
        result.distance = last;
        if (level == 0 && meetsPixel(ray, pixel, first, last, o, view, result.lost)) {
            result.outcome = marchHit;
            break;
        }
        result.clear = result.lost ? result.clear : last;
        // Across one border exactly; along the other axis, where the ray is then, but not out of the cell.
        ivec2 there = clamp(ivec2(floor(r.start.xy + sLast * r.delta.xy)), cell << level, ((cell + 1) << level) - 1);
        bool acrossX = s.x <= s.y;
        pixel.x = acrossX ? corner.x + min(direction.x, 0) : there.x;
        pixel.y = acrossX ? there.y : corner.y + min(direction.y, 0);
        if (sLast >= 1.0 || any(lessThan(pixel, ivec2(0))) || any(greaterThan(pixel, lastPixel))) {
            result.outcome = r.leaves ? marchLeftScreen : marchSpent;
            break;
        }
        first = last;
        level = i + 1u < o.firstSteps ? 0 : min(level + 1, o.levels - 1);
    }
    return placed(result, first, ray, o, view);
}

#endif
