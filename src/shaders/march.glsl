// Tracing a ray through a depth buffer: what all methods share. A method is a function
//     MarchResult march…(MarchRay ray, MarchOptions o, MarchView view)
// The includer defines, before it includes this: float loadDepth(ivec2 pixel) (reversed depth, 0: sky), and
// float loadBackDepth(ivec2 pixel): of the nearest back face behind that, 0: none (needed where o.secondLayer is set).
#ifndef REFLET_MARCH_GLSL
#define REFLET_MARCH_GLSL

#include "shaders/projection.glsl"

const uint marchHit = 0u;
const uint marchLeftScreen = 1u;  // beyond an edge, or behind the camera
const uint marchSpent = 2u;       // all steps taken, or as far as rays go: a miss
const uint marchHidden = 3u;      // went behind something thicker than it may be taken for: a miss

struct MarchResult {
    uint outcome;
    ivec2 pixel;     // of the hit; else the last one visited
    float distance;  // metres along the ray
    float clear;     // metres along the ray before it first went behind something, or left, or was given up
    bool lost;       // it went behind something (a hit may have come after)
    uint steps;      // depth samples taken
};

MarchResult startOfMarch() { return MarchResult(marchSpent, ivec2(0), 0.0, 0.0, false, 0u); }

struct MarchOptions {
    float stepLength;    // metres: linear, the first of halving, the first distance of the fixed point
    float smallest;      // metres: where halving ends; by how little the fixed point may still move
    float stride;        // pixels of a step of dda
    float longest;       // metres: no ray goes farther
    float jitter;        // 0..1: what part of a step the first one is
    uint maxSteps;
    float thickness;     // metres along the view
    bool thickAsStep;    // linear, halving: and as far as a step goes along the view
    bool secondLayer;    // up to the back face, where there is one
    uint binarySteps;    // after a hit of linear, halving, dda
    bool interpolate;    // then place it between the last two samples
    int levels;          // hiz: of the pyramid, pixels included
    uint firstSteps;     // hiz: of single pixels, before larger cells are tried
};

struct MarchView {
    mat4 worldToClip;
    mat4 clipToWorld;
    vec4 viewPlane;
    vec4 depthToDistance;
    vec2 size;
    vec2 pixel;  // 1 / size
};

// Clip coordinates and view distance ("away") are linear along the ray: one multiply-add each.
struct MarchRay {
    vec3 origin;  // world
    vec3 direction;
    vec4 clipStart;
    vec4 clipStep;
    float awayStart;
    float awayStep;
    vec4 ownPlane;  // the plane that the ray leaves, as planeOnScreen gives it
};

MarchRay makeMarchRay(vec3 originW, vec3 directionW, vec4 ownPlane, MarchView view) {
    return MarchRay(originW, directionW, view.worldToClip * vec4(originW, 1.0),
                    view.worldToClip * vec4(directionW, 0.0), dot(view.viewPlane, vec4(originW, 1.0)),
                    dot(view.viewPlane.xyz, directionW), ownPlane);
}

// Metres above the own plane per metre from the camera (orthographic: metres) that count as in it.
const float ownPlaneSlack = 5e-4;

// What the screen shows where the ray is after t metres.
struct MarchSample {
    bool onScreen;
    ivec2 pixel;
    float depth;
    float behind;  // metres along the view that the ray is behind it; negative: in front
    float thickness;  // metres along the view
    bool foreign;  // not in the plane that the ray leaves, nor below it
};

// What lies in the ray's own plane or below it cannot be hit from it. Without this, a surface seen at a slant is hit by
// rays that have only just left it, because one depth stands for all of a pixel's width. (Interpolated depth would tell
// as much, but wears half a pixel off every silhouette.) Nor can the sky be hit.
bool isForeign(MarchRay ray, ivec2 pixel, float depth, MarchView view) {
    return depth > 0.0 && dot(ray.ownPlane, vec4((vec2(pixel) + 0.5) * view.pixel, depth, 1.0)) > ownPlaneSlack;
}

// Whether a point `away` metres in front of the camera is no farther than what has this depth. A comparison of fractions
// by their products: marches ask it at every step, and CPUs divide slowly.
bool isInFrontOf(float away, float depth, MarchView view) {
    return away * (view.depthToDistance.z + view.depthToDistance.w * depth) <=
           view.depthToDistance.x + view.depthToDistance.y * depth;
}

// How thick, in metres along the view, what the pixel shows at the distance `front` is taken to be.
float thicknessAt(ivec2 pixel, float front, MarchOptions o, MarchView view) {
    if (o.secondLayer) {
        float back = loadBackDepth(pixel);
        if (back > 0.0) {
            return depthToViewDistance(back, view.depthToDistance) - front;
        }
    }
    return o.thickness;
}

MarchSample sampleAt(MarchRay ray, float t, MarchOptions o, MarchView view) {
    vec4 clip = ray.clipStart + t * ray.clipStep;
    vec2 uv = ndcToUv(clip.xy / clip.w);
    MarchSample s = MarchSample(false, ivec2(0), 0.0, 0.0, 0.0, false);
    s.onScreen = clip.w > 0.0 && clip.z <= clip.w && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
    if (s.onScreen) {
        s.pixel = ivec2(uv * view.size);
        s.depth = loadDepth(s.pixel);
        float front = depthToViewDistance(s.depth, view.depthToDistance);
        s.behind = ray.awayStart + t * ray.awayStep - front;
        s.thickness = thicknessAt(s.pixel, front, o, view);
        s.foreign = isForeign(ray, s.pixel, s.depth, view);
    }
    return s;
}

// A hit between a sample in front of what is shown (`before` metres along the ray, by -`behindBefore`) and one behind it
// (the hit, by `behindHit`): halved o.binarySteps times, then cut where a straight surface would be (similar triangles).
MarchResult refineHit(MarchResult hit, float before, float behindBefore, float behindHit, MarchRay ray, MarchOptions o,
                      MarchView view) {
    for (uint i = 0u; i < o.binarySteps; ++i) {
        float middle = 0.5 * (before + hit.distance);
        MarchSample s = sampleAt(ray, middle, o, view);
        ++hit.steps;
        if (s.onScreen && s.foreign && s.behind > 0.0) {
            hit.pixel = s.pixel;
            hit.distance = middle;
            behindHit = s.behind;
        } else {
            before = middle;
            behindBefore = s.foreign ? s.behind : 0.0;
        }
    }
    if (o.interpolate && behindHit > behindBefore) {
        float cut = mix(before, hit.distance, -behindBefore / (behindHit - behindBefore));
        MarchSample s = sampleAt(ray, cut, o, view);
        ++hit.steps;
        if (s.onScreen && s.foreign) {  // else it would be the sky's, or the ray's own plane
            hit.pixel = s.pixel;
            hit.distance = cut;
        }
    }
    return hit;
}

#endif
