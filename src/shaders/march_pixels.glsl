// Methods that step from pixel to pixel: every pixel that the ray crosses (the oracle), and a DDA with a stride.
// (McGuire and Mara, Efficient GPU Screen-Space Ray Tracing, JCGT 2014; Amanatides and Woo, A Fast Voxel Traversal
// Algorithm for Ray Tracing, 1987)
#ifndef REFLET_MARCH_PIXELS_GLSL
#define REFLET_MARCH_PIXELS_GLSL

#include "shaders/march.glsl"

// The part of a ray that is on the screen: there it is straight in (pixel x, pixel y, depth), from `start` by `delta`,
// while s goes from 0 to 1. With s0 = start's clip w and s1 the end's, metres along the ray are
// end · s · s0 / (s1 + s (s0 - s1)).
struct ScreenRay {
    vec3 start;
    vec3 delta;
    vec2 perPixel;  // 1 / delta.xy
    float end;     // metres
    float wStart;
    float wEnd;
    bool leaves;   // it ends at the edge of the screen; else it is as long as rays get
};

float metresAt(ScreenRay r, float s) {
    return r.end * s * r.wStart / (r.wEnd + s * (r.wStart - r.wEnd));
}

// Where along s the ray crosses the vertical and the horizontal line through the corner of a pixel. Corners are whole
// numbers: no error adds up over the way.
vec2 bordersAt(ScreenRay r, ivec2 corner) {
    vec2 way = (vec2(corner) - r.start.xy) * r.perPixel;
    return vec2(r.delta.x == 0.0 ? 1e30 : way.x, r.delta.y == 0.0 ? 1e30 : way.y);
}

// How far the ray may go until a + t · b is negative.
float lengthInside(float a, float b) { return b < 0.0 ? max(a / -b, 0.0) : 1e30; }

ScreenRay makeScreenRay(MarchRay ray, float longest, MarchView view) {
    vec4 a = ray.clipStart;
    vec4 b = ray.clipStep;
    float end = min(min(lengthInside(a.w + a.x, b.w + b.x), lengthInside(a.w - a.x, b.w - b.x)),
                    min(lengthInside(a.w + a.y, b.w + b.y), lengthInside(a.w - a.y, b.w - b.y)));
    end = min(end, min(lengthInside(a.w - a.z, b.w - b.z), lengthInside(a.z, b.z)));
    ScreenRay r;
    r.leaves = end <= longest;
    r.end = min(end, longest);
    vec4 last = a + r.end * b;
    r.wStart = a.w;
    r.wEnd = last.w;
    vec3 first = vec3(ndcToUv(a.xy / a.w) * view.size, a.z / a.w);
    r.start = first;
    r.delta = vec3(ndcToUv(last.xy / last.w) * view.size, last.z / last.w) - first;
    r.perPixel = 1.0 / r.delta.xy;
    return r;
}

// Whether the ray, between two distances, is behind what the pixel shows by less than its thickness. lost: set if it is
// behind it at all.
bool meetsPixel(MarchRay ray, ivec2 pixel, float first, float last, MarchOptions o, MarchView view, inout bool lost) {
    float depth = loadDepth(pixel);
    float awayFirst = ray.awayStart + first * ray.awayStep;
    float awayLast = ray.awayStart + last * ray.awayStep;
    if (isInFrontOf(max(awayFirst, awayLast), depth, view) || !isForeign(ray, pixel, depth, view)) {
        return false;
    }
    lost = true;
    float nearest = min(awayFirst, awayLast);
    if (o.secondLayer) {
        return nearest < depthToViewDistance(depth, view.depthToDistance) +
                             thicknessAt(pixel, depthToViewDistance(depth, view.depthToDistance), o, view);
    }
    return isInFrontOf(nearest - o.thickness, depth, view);
}

// Where between two distances a ray that meets the pixel first does.
float meetingPoint(MarchRay ray, ivec2 pixel, float first, float last, MarchOptions o, MarchView view) {
    float front = depthToViewDistance(loadDepth(pixel), view.depthToDistance);
    float back = front + thicknessAt(pixel, front, o, view);
    float awayFirst = ray.awayStart + first * ray.awayStep;
    if (awayFirst >= front && awayFirst <= back) {
        return first;
    }
    return clamp(((awayFirst < front ? front : back) - ray.awayStart) / ray.awayStep, first, last);
}

// A march's result, whose last step began at `first` and ended at its distance, with the distance of its hit.
MarchResult placed(MarchResult result, float first, MarchRay ray, MarchOptions o, MarchView view) {
    if (result.outcome == marchHit) {
        result.distance = meetingPoint(ray, result.pixel, first, result.distance, o, view);
    }
    return result;
}

// Every pixel that the ray crosses, in order, however many.
MarchResult marchExhaustive(MarchRay ray, MarchOptions o, MarchView view) {
    ScreenRay r = makeScreenRay(ray, o.longest, view);
    ivec2 lastPixel = ivec2(view.size) - 1;
    ivec2 pixel = clamp(ivec2(floor(r.start.xy)), ivec2(0), lastPixel);
    ivec2 direction = ivec2(sign(r.delta.xy));
    MarchResult result = startOfMarch();
    uint most = uint(view.size.x + view.size.y) + 2u;
    float first = 0.0;
    for (uint i = 0u; i < most; ++i) {
        vec2 s = bordersAt(r, pixel + max(direction, ivec2(0)));
        float sLast = min(min(s.x, s.y), 1.0);
        float last = metresAt(r, sLast);
        result.pixel = pixel;
        result.distance = last;
        result.steps = i + 1u;
        if (meetsPixel(ray, pixel, first, last, o, view, result.lost)) {
            result.outcome = marchHit;
            break;
        }
        result.clear = result.lost ? result.clear : last;
        pixel += s.x <= s.y ? ivec2(direction.x, 0) : ivec2(0, direction.y);
        if (sLast >= 1.0 || any(lessThan(pixel, ivec2(0))) || any(greaterThan(pixel, lastPixel))) {
            result.outcome = r.leaves ? marchLeftScreen : marchSpent;
            break;
        }
        first = last;
    }
    return placed(result, first, ray, o, view);
}

MarchSample sampleAlong(ScreenRay r, float s, MarchRay ray, MarchOptions o, MarchView view) {
    return sampleAt(ray, metresAt(r, s), o, view);
}

bool isBehind(MarchSample s) { return s.onScreen && s.foreign && s.behind > 0.0; }

// Looks for the hit of a wide stride between the samples around it: halves the way on the screen o.binarySteps times, so
// that it comes down to a pixel, then cuts where a straight surface would be. On the screen, the depths of the ray and
// of a plane are straight; along the ray in metres, one pixel may be longer than all others together.
MarchResult refineDda(MarchResult hit, ScreenRay r, float s, float sStep, MarchRay ray, MarchOptions o,
                      MarchView view) {
    bool late = isBehind(sampleAlong(r, s, ray, o, view));
    float a = late ? max(s - sStep, 0.0) : s;
    float b = late ? s : min(s + 0.5 * sStep, 1.0);
    MarchSample front = sampleAlong(r, a, ray, o, view);
    MarchSample behind = sampleAlong(r, b, ray, o, view);
    hit.steps += 2u;  // one of the three had been taken before
    if (isBehind(front) || !isBehind(behind)) {
        return hit;
    }
    hit.steps += o.binarySteps;
    for (uint i = 0u; i < o.binarySteps; ++i) {
        float middle = 0.5 * (a + b);
        MarchSample m = sampleAlong(r, middle, ray, o, view);
        if (isBehind(m)) {
            b = middle;
            behind = m;
        } else {
            a = middle;
            front = m;
        }
    }
    hit.pixel = behind.pixel;
    float awayStep = max(ray.awayStep, 1e-6);  // toward the camera, it came in by the pixel's border
    hit.distance = max(metresAt(r, b) - behind.behind / awayStep, metresAt(r, a));
    if (o.interpolate && front.onScreen && front.foreign) {
        float gapFront = r.start.z + a * r.delta.z - front.depth;
        float gapBehind = behind.depth - (r.start.z + b * r.delta.z);
        float cut = mix(a, b, clamp(gapFront / max(gapFront + gapBehind, 1e-20), 0.0, 1.0));
        MarchSample m = sampleAlong(r, cut, ray, o, view);
        ++hit.steps;
        if (m.onScreen && m.foreign) {
            hit.pixel = m.pixel;
            hit.distance = metresAt(r, cut);
        }
    }
    return hit;
}

// Steps of o.stride pixels along the axis on which the ray is longer. Each sample stands for the part of the ray that is
// nearer to it than to its neighbours. The first leaves to the pixel that the ray starts from what is nearer to that.
MarchResult marchDda(MarchRay ray, MarchOptions o, MarchView view) {
    ScreenRay r = makeScreenRay(ray, o.longest, view);
    float pixels = max(max(abs(r.delta.x), abs(r.delta.y)), 1e-3);
    float sStep = o.stride / pixels;
    MarchResult result = startOfMarch();
    float first = metresAt(r, min(max(o.jitter - 0.5, 0.0) * sStep, 1.0));
    for (uint i = 0u; i < o.maxSteps; ++i) {
        float s = (float(i) + o.jitter) * sStep;
        if (s >= 1.0) {
            result.outcome = r.leaves ? marchLeftScreen : marchSpent;
            break;
        }
        float last = metresAt(r, min(s + 0.5 * sStep, 1.0));
        result.pixel = clamp(ivec2(floor(r.start.xy + s * r.delta.xy)), ivec2(0), ivec2(view.size) - 1);
        result.steps = i + 1u;
        if (meetsPixel(ray, result.pixel, first, last, o, view, result.lost)) {
            result.outcome = marchHit;
            result.distance = meetingPoint(ray, result.pixel, first, last, o, view);
            bool refine = o.stride > 1.0 && (o.binarySteps > 0u || o.interpolate);  // a pixel leaves nothing to refine
            return refine ? refineDda(result, r, s, sStep, ray, o, view) : result;
        }
        result.distance = last;
        result.clear = result.lost ? result.clear : last;
        first = last;
    }
    return result;
}

#endif
