// Methods that step through the world and look where they are on the screen: fixed steps, halved steps, fixed point.
#ifndef REFLET_MARCH_WORLD_GLSL
#define REFLET_MARCH_WORLD_GLSL

#include "shaders/march.glsl"

// Metres along the view that a step of `stride` metres adds to the thickness.
float stepThickness(MarchRay ray, float stride, MarchOptions o) {
    return o.thickAsStep ? abs(ray.awayStep) * stride : 0.0;
}

// Fixed steps. A sample hits when it lies behind the surface that its pixel shows by less than the thickness.
MarchResult marchLinear(MarchRay ray, MarchOptions o, MarchView view) {
    MarchResult result = startOfMarch();
    float behindBefore = 0.0;
    float more = stepThickness(ray, o.stepLength, o);
    for (uint i = 0u; i < o.maxSteps; ++i) {
        float before = result.distance;
        float t = (float(i) + o.jitter) * o.stepLength;
        if (t > o.longest) {
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
        if (s.behind > 0.0 && s.foreign) {
            if (s.behind < s.thickness + more) {
                result.outcome = marchHit;
                return behindBefore <= 0.0 ? refineHit(result, before, behindBefore, s.behind, ray, o, view) : result;
            }
            result.lost = true;
        }
        result.clear = result.lost ? result.clear : t;
        behindBefore = s.foreign ? s.behind : 0.0;
    }
    return result;
}

// Steps that are halved whenever one would end behind something, until they are shorter than o.smallest; what the ray is
// then behind of by less than the thickness is hit. The first step is jitter times o.stepLength, the longest that it takes.
MarchResult marchHalving(MarchRay ray, MarchOptions o, MarchView view) {
    MarchResult result = startOfMarch();
    float behindBefore = 0.0;
    float stride = o.stepLength * o.jitter;
    for (uint i = 0u; i < o.maxSteps && result.clear + stride <= o.longest; ++i) {
        float t = result.clear + stride;
        MarchSample s = sampleAt(ray, t, o, view);
        if (!s.onScreen) {
            result.outcome = marchLeftScreen;
            break;
        }
        result.pixel = s.pixel;
        result.distance = t;
        result.steps = i + 1u;
        if (s.behind <= 0.0 || !s.foreign) {
            result.clear = t;
            behindBefore = s.foreign ? s.behind : 0.0;
            continue;
        }
        if (stride < o.smallest) {
            if (s.behind < s.thickness + stepThickness(ray, stride, o)) {
                result.outcome = marchHit;
                return refineHit(result, result.clear, behindBefore, s.behind, ray, o, view);
            }
            result.outcome = marchHidden;
            result.lost = true;
            break;
        }
        stride *= 0.5;
    }
    return result;
}

// The distance along the ray is replaced by the distance to the point that the screen shows there, until it no longer
// changes by more than o.smallest. Finds what is near where the ray first looks, or nothing.
MarchResult marchFixedPoint(MarchRay ray, MarchOptions o, MarchView view) {
    MarchResult result = startOfMarch();
    float t = o.stepLength;
    for (uint i = 0u; i < o.maxSteps && t <= o.longest; ++i) {
        MarchSample s = sampleAt(ray, t, o, view);
        if (!s.onScreen) {
            result.outcome = marchLeftScreen;
            break;
        }
        result.pixel = s.pixel;
        result.distance = t;
        result.steps = i + 1u;
        if (s.depth <= 0.0) {  // the sky is at no distance
            break;
        }
        vec3 shown = uvToWorld((vec2(s.pixel) + 0.5) / view.size, s.depth, view.clipToWorld);
        float there = distance(shown, ray.origin);
        if (abs(there - t) < o.smallest) {
            result.outcome = abs(s.behind) < s.thickness && s.foreign ? marchHit : marchHidden;
            break;
        }
        t = there;
    }
    return result;
}

#endif
