// Hierarchical depth: cells that a ray passes wholly in front of, or wholly behind by more than the thickness, are left
// in one step, and the next larger ones are tried; else the next smaller. (Uludag, Hi-Z Screen-Space Cone-Traced
// Reflections, GPU Pro 5, 2014, with nearest and farthest depth)
// The includer defines, before it includes this, also: vec2 loadCell(ivec2 cell, int level): the largest (nearest) and
// the smallest (farthest) reversed depth of the 2^level x 2^level pixels from cell · 2^level on; level is at least 1.
#ifndef REFLET_MARCH_HIZ_GLSL
#define REFLET_MARCH_HIZ_GLSL

#include "shaders/march_pixels.glsl"

// Whether anything in the cell can be hit between two distances along the ray.
bool mayMeetCell(MarchRay ray, vec2 depths, float first, float last, float thickness, MarchView view) {
    float awayFirst = ray.awayStart + first * ray.awayStep;
    float awayLast = ray.awayStart + last * ray.awayStep;
    float front = depthToViewDistance(depths.x, view.depthToDistance);
    float back = depthToViewDistance(depths.y, view.depthToDistance) + thickness;
    return max(awayFirst, awayLast) > front && min(awayFirst, awayLast) < back;
}

// Finds the pixel that marchExhaustive finds. levels: of the pyramid, pixels included.
MarchResult marchHiz(MarchRay ray, float longest, uint maxSteps, float thickness, int levels, MarchView view) {
    ScreenRay r = makeScreenRay(ray, longest, view);
    ivec2 lastPixel = ivec2(view.size) - 1;
    ivec2 pixel = clamp(ivec2(floor(r.start.xy)), ivec2(0), lastPixel);
    ivec2 direction = ivec2(sign(r.delta.xy));
    MarchResult result = MarchResult(marchSpent, pixel, 0.0, 0u);
    float first = 0.0;
    int level = 0;
    for (uint i = 0u; i < maxSteps; ++i) {
        // The cell's far border, as a whole number of pixels: no error adds up over the way.
        ivec2 cell = pixel >> level;
        ivec2 corner = (cell + max(direction, ivec2(0))) << level;
        vec2 border = vec2(corner) - r.start.xy;
        vec2 s = vec2(direction.x == 0 ? 1e30 : border.x / r.delta.x, direction.y == 0 ? 1e30 : border.y / r.delta.y);
        float sLast = min(min(s.x, s.y), 1.0);
        float last = metresAt(r, sLast);
        result.pixel = pixel;
        result.steps = i + 1u;
        if (level > 0) {
            if (mayMeetCell(ray, loadCell(cell, level), first, last, thickness, view)) {
                --level;
                continue;
            }
        } else {
            float at;
            if (meetsPixel(ray, pixel, first, last, thickness, view, at)) {
                result.outcome = marchHit;
                result.distance = at;
                break;
            }
        }
        result.distance = last;
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
        level = min(level + 1, levels - 1);
    }
    return result;
}

#endif
