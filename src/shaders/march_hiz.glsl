// Hierarchical depth (hi-Z) traversal: a cell that the ray passes entirely in front of, or entirely behind by more than
// the thickness, is skipped in one step, and the next coarser level is tried; otherwise the next finer one. (Uludag,
// Hi-Z Screen-Space Cone-Traced Reflections, GPU Pro 5, 2014, with nearest and farthest depth)
// The includer also defines, before it includes this: vec2 loadCell(ivec2 cell, int level), level at least 1. It
// returns the largest (nearest) and the smallest (farthest; of back faces if those are used) reversed depth of the
// 2^level x 2^level pixels from cell · 2^level on. The sky does not count; if some pixels show it, the second value is
// negative (0 and -1 if all do).
#ifndef REFLET_MARCH_HIZ_GLSL
#define REFLET_MARCH_HIZ_GLSL

#include "shaders/march_pixels.glsl"

// Whether the traversal must descend: between the two distances, the ray is neither entirely in front of the cell nor
// entirely behind it. occluded: set if it is behind; in a cell with sky, only the pixels can tell.
bool mustDescend(vec2 depths, MarchRay ray, float first, float last, MarchOptions o, MarchView view,
                 inout bool occluded) {
    float viewDistanceFirst = ray.viewDistanceStart + first * ray.viewDistanceStep;
    float viewDistanceLast = ray.viewDistanceStart + last * ray.viewDistanceStep;
    if (isInFrontOf(max(viewDistanceFirst, viewDistanceLast), depths.x, view)) {
        return false;
    }
    if (isInFrontOf(min(viewDistanceFirst, viewDistanceLast) - o.thickness, abs(depths.y), view) ||
        (depths.y < 0.0 && !occluded)) {
        return true;
    }
    occluded = true;
    return false;
}

// Finds the same pixel as marchExhaustive.
MarchResult marchHiz(MarchRay ray, MarchOptions o, MarchView view) {
    ScreenRay r = makeScreenRay(ray, o.maxDistance, view);
    ivec2 lastPixel = ivec2(view.size) - 1;
    ivec2 pixel = clamp(ivec2(floor(r.start.xy)), ivec2(0), lastPixel);
    ivec2 direction = ivec2(sign(r.delta.xy));
    MarchResult result = emptyMarchResult();
    float first = 0.0;
    int level = 0;
    for (uint i = 0u; i < o.maxSteps; ++i) {
        // The corner where the ray leaves the cell.
        ivec2 cell = pixel >> level;
        ivec2 corner = (cell + max(direction, ivec2(0))) << level;
        vec2 s = borderCrossings(r, corner);
        float sLast = min(min(s.x, s.y), 1.0);
        float last = distanceAlong(r, sLast);
        result.pixel = pixel;
        result.steps = i + 1u;
        if (level > 0 && mustDescend(loadCell(cell, level), ray, first, last, o, view, result.occluded)) {
            --level;
            continue;
        }
        result.distance = last;
        if (level == 0 && hitsPixel(ray, pixel, first, last, o, view, result.occluded)) {
            result.outcome = marchHit;
            break;
        }
        result.clear = result.occluded ? result.clear : last;
        // Exactly across one border; along the other axis to the ray's position, clamped to the cell.
        ivec2 there = clamp(ivec2(floor(r.start.xy + sLast * r.delta.xy)), cell << level, ((cell + 1) << level) - 1);
        bool acrossX = s.x <= s.y;
        pixel.x = acrossX ? corner.x + min(direction.x, 0) : there.x;
        pixel.y = acrossX ? there.y : corner.y + min(direction.y, 0);
        if (sLast >= 1.0 || any(lessThan(pixel, ivec2(0))) || any(greaterThan(pixel, lastPixel))) {
            result.outcome = r.leavesScreen ? marchLeftScreen : marchLimitReached;
            break;
        }
        first = last;
        level = i + 1u < o.firstSteps ? 0 : min(level + 1, o.levels - 1);
    }
    return withHitDistance(result, first, ray, o, view);
}

#endif
