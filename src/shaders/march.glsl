// Tracing a ray through a depth buffer: what all methods share. A method is a function from a MarchRay to a MarchResult.
// The includer defines, before it includes this: float loadDepth(ivec2 pixel) (reversed depth, 0: sky).
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
    uint steps;      // depth samples taken
};

struct MarchView {
    mat4 worldToClip;
    mat4 clipToWorld;
    vec4 viewPlane;
    vec4 depthToDistance;
    vec2 size;
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
    bool foreign;  // not in the plane that the ray leaves, nor below it
};

// What lies in the ray's own plane or below it cannot be hit from it. Without this, a surface seen at a slant is hit by
// rays that have only just left it, because one depth stands for all of a pixel's width. (Interpolated depth would tell
// as much, but wears half a pixel off every silhouette.) Nor can the sky be hit.
bool isForeign(MarchRay ray, ivec2 pixel, float depth, MarchView view) {
    return depth > 0.0 && dot(ray.ownPlane, vec4((vec2(pixel) + 0.5) / view.size, depth, 1.0)) > ownPlaneSlack;
}

MarchSample sampleAt(MarchRay ray, float t, MarchView view) {
    vec4 clip = ray.clipStart + t * ray.clipStep;
    vec2 uv = ndcToUv(clip.xy / clip.w);
    MarchSample s = MarchSample(false, ivec2(0), 0.0, 0.0, false);
    s.onScreen = clip.w > 0.0 && clip.z <= clip.w && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
    if (s.onScreen) {
        s.pixel = ivec2(uv * view.size);
        s.depth = loadDepth(s.pixel);
        s.behind = ray.awayStart + t * ray.awayStep - depthToViewDistance(s.depth, view.depthToDistance);
        s.foreign = isForeign(ray, s.pixel, s.depth, view);
    }
    return s;
}

#endif
