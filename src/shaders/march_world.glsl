// Methods that step through the world and look where they are on the screen: fixed steps, halved steps, fixed point.
#ifndef REFLET_MARCH_WORLD_GLSL
#define REFLET_MARCH_WORLD_GLSL

#include "shaders/march.glsl"

// Fixed steps. jitter: 0..1, what part of a step the first one is. A sample hits when it lies behind the surface that
// its pixel shows by less than `thickness` metres along the view.
MarchResult marchLinear(MarchRay ray, float stepLength, uint maxSteps, float thickness, float jitter, MarchView view) {
    MarchResult result = MarchResult(marchSpent, ivec2(0), 0.0, 0u);
    for (uint i = 0u; i < maxSteps; ++i) {
        float t = (float(i) + jitter) * stepLength;
        MarchSample s = sampleAt(ray, t, view);
        if (!s.onScreen) {
            result.outcome = marchLeftScreen;
            break;
        }
        result = MarchResult(marchSpent, s.pixel, t, i + 1u);
        if (s.behind > 0.0 && s.behind < thickness && s.foreign) {
            result.outcome = marchHit;
            break;
        }
    }
    return result;
}

// Steps that are halved whenever one would end behind something, until they are shorter than `smallest`; what the ray is
// then behind of by less than `thickness` is hit. The first step is `stepLength` times jitter, the longest that it takes.
MarchResult marchHalving(MarchRay ray, float stepLength, float smallest, uint maxSteps, float thickness, float jitter,
                         MarchView view) {
    MarchResult result = MarchResult(marchSpent, ivec2(0), 0.0, 0u);
    float before = 0.0;
    float stride = stepLength * jitter;
    for (uint i = 0u; i < maxSteps; ++i) {
        float t = before + stride;
        MarchSample s = sampleAt(ray, t, view);
        if (!s.onScreen) {
            result.outcome = marchLeftScreen;
            break;
        }
        result = MarchResult(marchSpent, s.pixel, t, i + 1u);
        if (s.behind <= 0.0 || !s.foreign) {
            before = t;
            continue;
        }
        if (stride < smallest) {
            result.outcome = s.behind < thickness ? marchHit : marchHidden;
            break;
        }
        stride *= 0.5;
    }
    return result;
}

// The distance along the ray is replaced by the distance to the point that the screen shows there, until it no longer
// changes by more than `tolerance`. Finds what is near where the ray first looks, or nothing.
MarchResult marchFixedPoint(MarchRay ray, float firstDistance, float tolerance, uint maxSteps, float thickness,
                            MarchView view) {
    MarchResult result = MarchResult(marchSpent, ivec2(0), 0.0, 0u);
    float t = firstDistance;
    for (uint i = 0u; i < maxSteps; ++i) {
        MarchSample s = sampleAt(ray, t, view);
        if (!s.onScreen) {
            result.outcome = marchLeftScreen;
            break;
        }
        result = MarchResult(marchSpent, s.pixel, t, i + 1u);
        if (s.depth <= 0.0) {  // the sky is at no distance
            break;
        }
        vec3 shown = uvToWorld((vec2(s.pixel) + 0.5) / view.size, s.depth, view.clipToWorld);
        float there = distance(shown, ray.origin);
        if (abs(there - t) < tolerance) {
            result.outcome = abs(s.behind) < thickness && s.foreign ? marchHit : marchHidden;
            break;
        }
        t = there;
    }
    return result;
}

#endif
