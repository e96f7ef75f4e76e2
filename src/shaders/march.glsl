// Marching a ray through a depth buffer.
// The includer defines, before it includes this: float loadDepth(ivec2 pixel) (reversed depth, 0: sky).
#ifndef REFLET_MARCH_GLSL
#define REFLET_MARCH_GLSL

#include "shaders/projection.glsl"

const uint marchHit = 0u;
const uint marchLeftScreen = 1u;  // beyond an edge, or behind the camera
const uint marchSpent = 2u;       // all steps taken: a miss

struct MarchResult {
    uint outcome;
    ivec2 pixel;     // of the hit; else the last one visited
    float distance;  // metres along the ray
    uint steps;      // depth samples taken
};

struct MarchView {
    mat4 worldToClip;
    vec4 viewPlane;
    vec4 depthToDistance;
    vec2 size;
};

// Metres above the own plane per metre from the camera (orthographic: metres) that count as in it.
const float ownPlaneSlack = 5e-4;

// Fixed steps in the world. jitter: 0..1, what part of a step the first one is. A sample hits when it lies behind the
// surface that its pixel shows by less than `thickness` metres along the view.
// ownPlane: the plane that the ray leaves, as planeOnScreen gives it. What lies in it or below it cannot be hit from it.
// Without this, a surface seen at a slant is hit by rays that have only just left it, because one depth stands for all of
// a pixel's width. (Interpolated depth would tell as much, but wears half a pixel off every silhouette.)
// Clip coordinates and view distance are linear along the ray: one multiply-add a step each.
MarchResult marchLinear(vec3 originW, vec3 directionW, float stepLength, uint maxSteps, float thickness, float jitter,
                        vec4 ownPlane, MarchView view) {
    vec4 clipStart = view.worldToClip * vec4(originW, 1.0);
    vec4 clipStep = view.worldToClip * vec4(directionW, 0.0);
    float awayStart = dot(view.viewPlane, vec4(originW, 1.0));
    float awayStep = dot(view.viewPlane.xyz, directionW);
    MarchResult result = MarchResult(marchSpent, ivec2(0), 0.0, 0u);
    for (uint i = 0u; i < maxSteps; ++i) {
        float t = (float(i) + jitter) * stepLength;
        vec4 clip = clipStart + t * clipStep;
        vec2 uv = ndcToUv(clip.xy / clip.w);
        if (clip.w <= 0.0 || clip.z > clip.w || any(lessThan(uv, vec2(0.0))) ||
            any(greaterThanEqual(uv, vec2(1.0)))) {
            result.outcome = marchLeftScreen;
            break;
        }
        result.pixel = ivec2(uv * view.size);
        result.distance = t;
        result.steps = i + 1u;
        float depth = loadDepth(result.pixel);
        float behind = awayStart + t * awayStep - depthToViewDistance(depth, view.depthToDistance);
        float above = dot(ownPlane, vec4((vec2(result.pixel) + 0.5) / view.size, depth, 1.0));
        if (behind > 0.0 && behind < thickness && above > ownPlaneSlack) {
            result.outcome = marchHit;
            break;
        }
    }
    return result;
}

#endif
