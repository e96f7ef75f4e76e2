// Ray marching in world space, with a look-up in the depth buffer at each step: fixed steps, halved steps, fixed-point
// iteration.
#ifndef REFLET_MARCH_WORLD_GLSL
#define REFLET_MARCH_WORLD_GLSL

#include "shaders/march.glsl"

// Thickness that a step of `stride` metres adds, in metres along the view.
float stepThickness(MarchRay ray, float stride, MarchOptions o) {
    return o.thickAsStep ? abs(ray.viewDistanceStep) * stride : 0.0;
}

// Fixed steps. A sample hits if it is behind the depth of its pixel by less than the thickness.
MarchResult marchLinear(MarchRay ray, MarchOptions o, MarchView view) {
    MarchResult result = emptyMarchResult();
    float behindBefore = 0.0;
    float more = stepThickness(ray, o.stepLength, o);
    for (uint i = 0u; i < o.maxSteps; ++i) {
        float before = result.distance;
        float t = (float(i) + o.jitter) * o.stepLength;
        if (t > o.maxDistance) {
            break;
        }
        MarchSample s = sampleAt(ray, t, o, view);
        if (!s.onScreen) {
            result.outcome = marchLeftScreen;
            break;
        }
        result.pixel = s.pixel;
        result.distance = t;
        result.steps = i + 1u;
        if (s.behind > 0.0 && s.hittable) {
            if (s.behind < s.thickness + more) {
                result.outcome = marchHit;
                return behindBefore <= 0.0 ? refineHit(result, before, behindBefore, s.behind, ray, o, view) : result;
            }
            result.occluded = true;
        }
        result.clear = result.occluded ? result.clear : t;
        behindBefore = s.hittable ? s.behind : 0.0;
    }
    return result;
}

// Adaptive steps: a step that would end behind a surface is halved, until it is shorter than o.minStep; then the ray
// hits if it is behind the surface by less than the thickness. The first and longest step is jitter times o.stepLength.
MarchResult marchHalving(MarchRay ray, MarchOptions o, MarchView view) {
    // Few variables change in the loop: on CPUs each is memory.
    float clear = 0.0;
    float behindBefore = 0.0;
    float stride = o.stepLength * o.jitter;
    uint steps = 0u;
    uint outcome = marchLimitReached;
    while (outcome == marchLimitReached && steps < o.maxSteps && clear + stride <= o.maxDistance) {
        MarchSample s = sampleAt(ray, clear + stride, o, view);
        bool behind = s.behind > 0.0 && s.hittable;
        bool ends = behind && stride < o.minStep;
        outcome = !s.onScreen ? marchLeftScreen : (ends ? marchHit : marchLimitReached);
        bool advances = s.onScreen && !behind;
        clear = advances ? clear + stride : clear;
        behindBefore = advances ? (s.hittable ? s.behind : 0.0) : behindBefore;
        stride = behind && !ends ? 0.5 * stride : stride;
        steps += s.onScreen ? 1u : 0u;
    }
    MarchResult result = emptyMarchResult();
    result.outcome = outcome;
    result.clear = clear;
    result.steps = steps;
    result.distance = outcome == marchHit ? clear + stride : clear;
    MarchSample s = sampleAt(ray, result.distance, o, view);
    result.pixel = s.pixel;
    if (outcome == marchHit) {
        if (s.behind < s.thickness + stepThickness(ray, stride, o)) {
            return refineHit(result, clear, behindBefore, s.behind, ray, o, view);
        }
        result.outcome = marchOccluded;
        result.occluded = true;
    }
    return result;
}

// Fixed-point iteration: the distance along the ray is replaced by the distance to the point that the screen shows
// there, until it changes by less than o.minStep. Finds only hits near the first look-up.
MarchResult marchFixedPoint(MarchRay ray, MarchOptions o, MarchView view) {
    MarchResult result = emptyMarchResult();
    float t = o.stepLength;
    for (uint i = 0u; i < o.maxSteps && t <= o.maxDistance; ++i) {
        MarchSample s = sampleAt(ray, t, o, view);
        if (!s.onScreen) {
            result.outcome = marchLeftScreen;
            break;
        }
        result.pixel = s.pixel;
        result.distance = t;
        result.steps = i + 1u;
        if (s.depth <= 0.0) {  // the sky has no distance
            break;
        }
        vec3 shown = uvToWorld((vec2(s.pixel) + 0.5) / view.size, s.depth, view.clipToWorld);
        float there = distance(shown, ray.origin);
        if (abs(there - t) < o.minStep) {
            result.outcome = abs(s.behind) < s.thickness && s.hittable ? marchHit : marchOccluded;
            break;
        }
        t = there;
    }
    return result;
}

#endif
