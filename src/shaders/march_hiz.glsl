// Hierarchical depth (hi-Z) traversal: a cell that the ray passes entirely in front of, or entirely behind by more than
// the thickness, is skipped in one step, and at its parent's border the next coarser level is tried; otherwise the next finer one. (Uludag,
// Hi-Z Screen-Space Cone-Traced Reflections, GPU Pro 5, 2014, with nearest and farthest depth)
// The includer also defines, before it includes this: vec2 loadCell(ivec2 cell, int level). It
// returns the largest (nearest) and the smallest (farthest; of back faces if those are used) reversed depth of the
// 2^level x 2^level pixels from cell · 2^level on. The sky does not count; if some pixels show it, the second value is
// negative (0 and -1 if all do). Of level 0 it returns loadDepth and loadBackDepth, which is not read unless
// MarchOptions.secondLayer.
#ifndef REFLET_MARCH_HIZ_GLSL
#define REFLET_MARCH_HIZ_GLSL

#include "shaders/march_pixels.glsl"

// Whether the ray, between two distances, is neither entirely in front of a cell nor entirely behind it: then it hits the
// cell if that is a pixel, by hitsPixel's rules, and else must descend. behind, occluded: as of hitsPixel; in a cell with
// sky, only the pixels can tell. One load and no branch for all levels: lanes of a wave are at different ones.
bool isWithin(ivec2 cell, int level, MarchRay ray, float first, float last, MarchOptions o, MarchView view,
              inout bool behind, inout bool occluded) {
    vec2 depths = loadCell(cell, level);
    bool isPixel = level == 0;
    bool hasBack = o.secondLayer && depths.y > 0.0;
    float farthest = isPixel && !hasBack ? depths.x : abs(depths.y);
    float viewDistanceFirst = ray.viewDistanceStart + first * ray.viewDistanceStep;
    float viewDistanceLast = ray.viewDistanceStart + last * ray.viewDistanceStep;
    float nearest = min(viewDistanceFirst, viewDistanceLast);
    bool hittable = isHittable(ray, cell, depths.x, view);
    bool inFront = isInFrontOf(max(viewDistanceFirst, viewDistanceLast), depths.x, view) || (isPixel && !hittable);
    bool within = isInFrontOf(nearest - (isPixel && hasBack ? 0.0 : o.thickness), farthest, view);
    within = within || (!isPixel && depths.y < 0.0 && !occluded);
    bool fromBehind = isPixel ? behind && !isInFrontOf(nearest, depths.x, view) : behind;
    behind = !inFront && (within ? fromBehind : true);
    occluded = occluded || !(inFront || within);
    return !inFront && within;
}

// Finds the same pixel as marchExhaustive.
MarchResult marchHiz(MarchRay ray, MarchOptions o, MarchView view) {
    ScreenRay r = makeScreenRay(ray, o.maxDistance, view);
    ivec2 lastPixel = ivec2(view.size) - 1;
    ivec2 pixel = clamp(ivec2(floor(r.start.xy)), ivec2(0), lastPixel);
    ivec2 direction = ivec2(sign(r.delta.xy));
    // Few variables change in the loop, and only by selection: on CPUs each is memory.
    uint outcome = marchLimitReached;
    uint steps = 0u;
    int level = 0;
    float first = 0.0;
    float last = 0.0;
    float clear = 0.0;
    bool behind = false;
    bool occluded = false;
    bool ended = false;
    while (!ended && steps < o.maxSteps) {
        // The corner where the ray leaves the cell.
        ivec2 cell = pixel >> level;
        ivec2 low = cell << level;
        ivec2 corner = (cell + max(direction, ivec2(0))) << level;
        vec2 s = borderCrossings(r, corner);
        float sLast = min(min(s.x, s.y), 1.0);
        float there = distanceAlong(r, sLast);
        ++steps;
        bool within = isWithin(cell, level, ray, first, there, o, view, behind, occluded);
        bool descends = within && level > 0;
        bool hit = within && level == 0;
        last = descends ? last : there;
        clear = descends || hit || occluded ? clear : there;
        // Exactly across one border; along the other axis to the ray's position, clamped to the cell.
        ivec2 across = clamp(ivec2(floor(r.start.xy + sLast * r.delta.xy)), low, low + (1 << level) - 1);
        ivec2 next = s.x <= s.y ? ivec2(corner.x + min(direction.x, 0), across.y)
                                : ivec2(across.x, corner.y + min(direction.y, 0));
        bool leaves = sLast >= 1.0 || any(lessThan(next, ivec2(0))) || any(greaterThan(next, lastPixel));
        ended = hit || (leaves && !descends);
        outcome = hit ? (behind ? marchOccluded : marchHit) : (ended ? (r.leavesScreen ? marchLeftScreen : marchLimitReached) : outcome);
        // Of a coarser cell that it had to descend into, the ray tests all parts before it tries that level again.
        bool climbs = steps >= o.firstSteps && any(notEqual((next ^ pixel) >> (level + 1), ivec2(0)));
        pixel = ended || descends ? pixel : next;
        first = ended || descends ? first : there;
        level = descends ? level - 1 : (climbs ? min(level + 1, o.levels - 1) : level);
    }
    MarchResult result = MarchResult(outcome, pixel, last, clear, occluded, steps);
    return withHitDistance(result, first, ray, o, view);
}

#endif
