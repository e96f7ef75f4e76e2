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
    bool hittable = isHittable(ray, cell, depths.x);
    bool inFront = isInFrontOf(max(viewDistanceFirst, viewDistanceLast), depths.x, view) || (isPixel && !hittable);
    bool within = isInFrontOf(nearest - (isPixel && hasBack ? 0.0 : o.thickness), farthest, view);
    within = within || (!isPixel && depths.y < 0.0 && !occluded);
    bool fromBehind = isPixel ? behind && !isInFrontOf(nearest, depths.x, view) : behind;
    behind = !inFront && (within ? fromBehind : true);
    occluded = occluded || !(inFront || within);
    return !inFront && within;
}

// Where a ray is before a step.
struct HizState {
    ivec2 pixel;    // at which it enters the cell; negative: that of the ray's origin
    int level;      // of the cell
    float first;    // metres along the ray: where it enters it
    float clear;    // as of MarchResult
    bool behind;    // as of hitsPixel
    bool occluded;  // as of MarchResult
};

// Of a ray that has not made a step.
HizState hizStart() { return HizState(ivec2(-1), 0, 0.0, 0.0, false, false); }

// Goes on from a state, with step number `steps`, until it ends or step number `end` (then the outcome is marchUnfinished, if
// o.maxSteps are more, and the state is that before that step). Finds the same pixel as marchExhaustive.
MarchResult marchHizOn(inout HizState state, uint steps, uint end, MarchRay ray, MarchOptions o, MarchView view) {
    ScreenRay r = makeScreenRay(ray, o.maxDistance, view);
    ivec2 lastPixel = ivec2(view.size) - 1;
    ivec2 pixel = state.pixel.x < 0 ? clamp(ivec2(floor(r.start.xy)), ivec2(0), lastPixel) : state.pixel;
    // What does not change in the loop: compilers for GPUs do not take it out. Along an axis that the ray does not follow it
    // never meets the next border.
    bvec2 forward = greaterThanEqual(r.delta.xy, vec2(0.0));
    ivec2 ahead = ivec2(forward);
    vec2 perPixel = mix(r.perPixel, vec2(1e30), equal(r.delta.xy, vec2(0.0)));
    float span = r.wStart - r.wEnd;
    float scale = r.end * r.wStart;
    // Few variables change in the loop, and only by selection: on CPUs each is memory.
    uint outcome = end < o.maxSteps ? marchUnfinished : marchLimitReached;
    int level = state.level;
    float first = state.first;
    float last = state.first;
    float clear = state.clear;
    bool behind = state.behind;
    bool occluded = state.occluded;
    bool ended = false;
    while (!ended && steps < end) {
        // The corner where the ray leaves the cell.
        ivec2 cell = pixel >> level;
        ivec2 low = cell << level;
        ivec2 corner = (cell + ahead) << level;
        vec2 s = (vec2(corner) - r.start.xy) * perPixel;
        float sLast = min(min(s.x, s.y), 1.0);
        float there = scale * sLast / (r.wEnd + sLast * span);
        ++steps;
        bool within = isWithin(cell, level, ray, first, there, o, view, behind, occluded);
        bool descends = within && level > 0;
        bool hit = within && level == 0;
        last = descends ? last : there;
        clear = descends || hit || occluded ? clear : there;
        // Exactly across one border; along the other axis to the ray's position, clamped to the cell.
        ivec2 across = clamp(ivec2(floor(r.start.xy + sLast * r.delta.xy)), low, low + (1 << level) - 1);
        corner += ahead - 1;
        ivec2 next = s.x <= s.y ? ivec2(corner.x, across.y) : ivec2(across.x, corner.y);
        bool leaves = sLast >= 1.0 || any(greaterThan(uvec2(next), uvec2(lastPixel)));  // or negative
        ended = hit || (leaves && !descends);
        outcome = hit ? (behind ? marchOccluded : marchHit) : (ended ? (r.leavesScreen ? marchLeftScreen : marchLimitReached) : outcome);
        // Of a coarser cell that it had to descend into, the ray tests all parts before it tries that level again.
        bool climbs = steps >= o.firstSteps && any(notEqual((next ^ pixel) >> (level + 1), ivec2(0)));
        pixel = ended || descends ? pixel : next;
        first = ended || descends ? first : there;
        level = descends ? level - 1 : (climbs ? min(level + 1, o.levels - 1) : level);
    }
    state = HizState(pixel, level, first, clear, behind, occluded);
    MarchResult result = MarchResult(outcome, pixel, last, clear, occluded, steps);
    return withHitDistance(result, first, ray, o, view);
}

MarchResult marchHiz(MarchRay ray, MarchOptions o, MarchView view) {
    HizState state = hizStart();
    return marchHizOn(state, 0u, o.maxSteps, ray, o, view);
}

#endif
