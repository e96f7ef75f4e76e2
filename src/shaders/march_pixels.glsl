// Screen-space ray marching from pixel to pixel: every pixel that the ray crosses (the exhaustive reference), or a DDA
// with a stride. (McGuire and Mara, Efficient GPU Screen-Space Ray Tracing, JCGT 2014; Amanatides and Woo, A Fast Voxel
// Traversal Algorithm for Ray Tracing, 1987)
#ifndef REFLET_MARCH_PIXELS_GLSL
#define REFLET_MARCH_PIXELS_GLSL

#include "shaders/march.glsl"

// The on-screen part of a ray: a straight line in (pixel x, pixel y, depth), start + s · delta with s from 0 to 1. With
// s0 the start's clip w and s1 the end's, the distance along the ray in metres is end · s · s0 / (s1 + s (s0 - s1)).
struct ScreenRay {
    vec3 start;
    vec3 delta;
    vec2 perPixel;  // 1 / delta.xy
    float end;      // metres
    float wStart;
    float wEnd;
    bool leavesScreen;  // it ends at the edge of the screen, not at the maximum distance
};

float distanceAlong(ScreenRay r, float s) {
    return r.end * s * r.wStart / (r.wEnd + s * (r.wStart - r.wEnd));
}

// Values of s at which the ray crosses the vertical and the horizontal line through a pixel's corner. Corners are whole
// numbers, so no error accumulates along the ray.
vec2 borderCrossings(ScreenRay r, ivec2 corner) {
    vec2 way = (vec2(corner) - r.start.xy) * r.perPixel;
    return vec2(r.delta.x == 0.0 ? 1e30 : way.x, r.delta.y == 0.0 ? 1e30 : way.y);
}

// Distance t at which a + t · b becomes negative.
float distanceToClipPlane(float a, float b) { return b < 0.0 ? max(a / -b, 0.0) : 1e30; }

ScreenRay makeScreenRay(MarchRay ray, float maxDistance, MarchView view) {
    vec4 a = ray.clipStart;
    vec4 b = ray.clipStep;
    float end = min(min(distanceToClipPlane(a.w + a.x, b.w + b.x), distanceToClipPlane(a.w - a.x, b.w - b.x)),
                    min(distanceToClipPlane(a.w + a.y, b.w + b.y), distanceToClipPlane(a.w - a.y, b.w - b.y)));
    end = min(end, min(distanceToClipPlane(a.w - a.z, b.w - b.z), distanceToClipPlane(a.z, b.z)));
    ScreenRay r;
    r.leavesScreen = end <= maxDistance;
    r.end = min(end, maxDistance);
    vec4 last = a + r.end * b;
    r.wStart = a.w;
    r.wEnd = last.w;
    vec3 first = vec3(ndcToUv(a.xy / a.w) * view.size, a.z / a.w);
    r.start = first;
    r.delta = vec3(ndcToUv(last.xy / last.w) * view.size, last.z / last.w) - first;
    r.perPixel = 1.0 / r.delta.xy;
    return r;
}

// Whether the ray, between two distances, is behind the depth of the pixel by less than its thickness. behind: whether it
// was behind what the pixel before shows; left set by a hit if the ray has not been in front of this surface either, so
// that it got into it out of sight (marchOccluded): the screen does not show where. occluded: set if the ray passes
// behind the pixel.
bool hitsPixel(MarchRay ray, ivec2 pixel, float first, float last, MarchOptions o, MarchView view,
               inout bool behind, inout bool occluded) {
    float depth = loadDepth(pixel);
    float viewDistanceFirst = ray.viewDistanceStart + first * ray.viewDistanceStep;
    float viewDistanceLast = ray.viewDistanceStart + last * ray.viewDistanceStep;
    if (isInFrontOf(max(viewDistanceFirst, viewDistanceLast), depth, view) || !isHittable(ray, pixel, depth)) {
        behind = false;
        return false;
    }
    float nearest = min(viewDistanceFirst, viewDistanceLast);
    bool hit = isInFrontOf(nearest - o.thickness, depth, view);
    if (o.secondLayer) {
        float back = loadBackDepth(pixel);
        hit = isInFrontOf(back > 0.0 ? nearest : nearest - o.thickness, back > 0.0 ? back : depth, view);
    }
    behind = !hit || (behind && !isInFrontOf(nearest, depth, view));
    occluded = occluded || !hit;
    return hit;
}

// Distance at which the ray first hits the pixel, which it does between the two distances.
float distanceToPixelHit(MarchRay ray, ivec2 pixel, float first, float last, MarchOptions o, MarchView view) {
    float front = depthToViewDistance(loadDepth(pixel), view.depthToDistance);
    float back = front + thicknessAt(pixel, front, o, view);
    float viewDistanceFirst = ray.viewDistanceStart + first * ray.viewDistanceStep;
    if (viewDistanceFirst >= front && viewDistanceFirst <= back) {
        return first;
    }
    float boundary = viewDistanceFirst < front ? front : back;
    return clamp((boundary - ray.viewDistanceStart) / ray.viewDistanceStep, first, last);
}

// Sets the distance of a hit; the last step of the march went from `first` to the result's distance.
MarchResult withHitDistance(MarchResult result, float first, MarchRay ray, MarchOptions o, MarchView view) {
    if (result.outcome == marchHit) {
        result.distance = distanceToPixelHit(ray, result.pixel, first, result.distance, o, view);
    }
    return result;
}

// Visits every pixel that the ray crosses, in order, without a step limit.
MarchResult marchExhaustive(MarchRay ray, MarchOptions o, MarchView view) {
    ScreenRay r = makeScreenRay(ray, o.maxDistance, view);
    ivec2 lastPixel = ivec2(view.size) - 1;
    ivec2 pixel = clamp(ivec2(floor(r.start.xy)), ivec2(0), lastPixel);
    ivec2 direction = ivec2(sign(r.delta.xy));
    MarchResult result = emptyMarchResult();
    uint most = uint(view.size.x + view.size.y) + 2u;
    float first = 0.0;
    bool behind = false;
    for (uint i = 0u; i < most; ++i) {
        vec2 s = borderCrossings(r, pixel + max(direction, ivec2(0)));
        float sLast = min(min(s.x, s.y), 1.0);
        float last = distanceAlong(r, sLast);
        result.pixel = pixel;
        result.distance = last;
        result.steps = i + 1u;
        if (hitsPixel(ray, pixel, first, last, o, view, behind, result.occluded)) {
            result.outcome = behind ? marchOccluded : marchHit;
            break;
        }
        result.clear = result.occluded ? result.clear : last;
        pixel += s.x <= s.y ? ivec2(direction.x, 0) : ivec2(0, direction.y);
        if (sLast >= 1.0 || any(lessThan(pixel, ivec2(0))) || any(greaterThan(pixel, lastPixel))) {
            result.outcome = r.leavesScreen ? marchLeftScreen : marchLimitReached;
            break;
        }
        first = last;
    }
    return withHitDistance(result, first, ray, o, view);
}

MarchSample sampleAlong(ScreenRay r, float s, MarchRay ray, MarchOptions o, MarchView view) {
    return sampleAt(ray, distanceAlong(r, s), o, view);
}

bool isBehind(MarchSample s) { return s.onScreen && s.hittable && s.behind > 0.0; }

// Refines a hit of a wide stride between the samples around it: o.binarySteps bisections in screen space, then
// (o.interpolate) the intersection with a plane through both samples. Bisection is in screen space because the depths
// of ray and plane are linear there; in metres along the ray, one pixel may be longer than all others together.
MarchResult refineDda(MarchResult hit, ScreenRay r, float s, float sStep, MarchRay ray, MarchOptions o,
                      MarchView view) {
    bool late = isBehind(sampleAlong(r, s, ray, o, view));
    float a = late ? max(s - sStep, 0.0) : s;
    float b = late ? s : min(s + 0.5 * sStep, 1.0);
    MarchSample front = sampleAlong(r, a, ray, o, view);
    MarchSample behind = sampleAlong(r, b, ray, o, view);
    hit.steps += 2u;  // one of the three samples was already counted
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
    float viewDistanceStep = max(ray.viewDistanceStep, 1e-6);  // toward the camera: entered across the border
    hit.distance = max(distanceAlong(r, b) - behind.behind / viewDistanceStep, distanceAlong(r, a));
    if (o.interpolate && front.onScreen && front.hittable) {
        float gapFront = r.start.z + a * r.delta.z - front.depth;
        float gapBehind = behind.depth - (r.start.z + b * r.delta.z);
        float cut = mix(a, b, clamp(gapFront / max(gapFront + gapBehind, 1e-20), 0.0, 1.0));
        MarchSample m = sampleAlong(r, cut, ray, o, view);
        ++hit.steps;
        if (m.onScreen && m.hittable) {
            hit.pixel = m.pixel;
            hit.distance = distanceAlong(r, cut);
        }
    }
    return hit;
}

// Steps of o.stride pixels along the major axis of the ray on the screen. Each sample covers the half steps before and
// after it; the first does not cover the part that is nearer to the start pixel.
MarchResult marchDda(MarchRay ray, MarchOptions o, MarchView view) {
    ScreenRay r = makeScreenRay(ray, o.maxDistance, view);
    float pixels = max(max(abs(r.delta.x), abs(r.delta.y)), 1e-3);
    float sStep = o.stride / pixels;
    MarchResult result = emptyMarchResult();
    float first = distanceAlong(r, min(max(o.jitter - 0.5, 0.0) * sStep, 1.0));
    bool behind = false;
    for (uint i = 0u; i < o.maxSteps; ++i) {
        float s = (float(i) + o.jitter) * sStep;
        if (s >= 1.0) {
            result.outcome = r.leavesScreen ? marchLeftScreen : marchLimitReached;
            break;
        }
        float last = distanceAlong(r, min(s + 0.5 * sStep, 1.0));
        result.pixel = clamp(ivec2(floor(r.start.xy + s * r.delta.xy)), ivec2(0), ivec2(view.size) - 1);
        result.steps = i + 1u;
        if (hitsPixel(ray, result.pixel, first, last, o, view, behind, result.occluded)) {
            result.outcome = behind ? marchOccluded : marchHit;
            result.distance = distanceToPixelHit(ray, result.pixel, first, last, o, view);
            bool refine = !behind && o.stride > 1.0 && (o.binarySteps > 0u || o.interpolate);  // a single pixel needs none
            return refine ? refineDda(result, r, s, sStep, ray, o, view) : result;
        }
        result.distance = last;
        result.clear = result.occluded ? result.clear : last;
        first = last;
    }
    return result;
}

#endif
