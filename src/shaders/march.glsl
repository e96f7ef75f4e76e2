// Ray marching through a depth buffer: what all methods share. A method is a function
//     MarchResult march…(MarchRay ray, MarchOptions o, MarchView view)
// The includer defines, before it includes this: float loadDepth(ivec2 pixel) (reversed depth, 0: sky), and float
// loadBackDepth(ivec2 pixel): of the nearest back face behind that, 0: none (needed if o.secondLayer is set).
#ifndef REFLET_MARCH_GLSL
#define REFLET_MARCH_GLSL

#include "shaders/projection.glsl"

const uint marchHit = 0u;
const uint marchLeftScreen = 1u;    // off-screen: beyond an edge, or behind the camera
const uint marchLimitReached = 2u;  // step limit or maximum distance reached: a miss
const uint marchOccluded = 3u;      // went behind something thicker than the thickness: a miss
const uint marchUnfinished = 4u;    // marchHizOn: goes on from its state

struct MarchResult {
    uint outcome;
    ivec2 pixel;     // of the hit; else the last pixel visited
    float distance;  // metres along the ray
    float clear;     // metres along the ray known to be free: before it first went behind something, left or ended
    bool occluded;   // it went behind something (possibly before a hit)
    uint steps;      // depth look-ups
};

MarchResult emptyMarchResult() { return MarchResult(marchLimitReached, ivec2(0), 0.0, 0.0, false, 0u); }

struct MarchOptions {
    float stepLength;   // metres: linear; the first step of halving; the first distance of fixed_point
    float minStep;      // metres: where halving ends; tolerance of fixed_point
    float stride;       // dda: pixels per step
    float maxDistance;  // metres
    float jitter;       // 0..1: length of the first step, in steps
    uint maxSteps;
    float thickness;   // metres along the view
    bool thickAsStep;  // linear, halving: add the length of a step along the view
    bool secondLayer;  // thickness reaches to the back face, where there is one
    uint binarySteps;  // bisection steps after a hit of linear, halving, dda
    bool interpolate;  // then interpolate between the last two samples
    int levels;        // hiz: levels of the pyramid, including the pixels
    uint firstSteps;   // hiz: steps of single pixels before larger cells are tried
};

struct MarchView {
    mat4 worldToClip;
    mat4 clipToWorld;
    vec4 viewPlane;
    vec4 depthToDistance;
    vec2 size;
    vec2 pixel;  // 1 / size
};

// Clip coordinates and view distance (metres in front of the camera) are linear along the ray: one multiply-add each.
struct MarchRay {
    vec3 origin;  // world
    vec3 direction;
    vec4 clipStart;
    vec4 clipStep;
    float viewDistanceStart;
    float viewDistanceStep;
    vec4 ownPlane;  // of (pixel x, pixel y, depth, 1): above 0 outside of the plane that the ray starts from
};

// Height above the ray's own plane that still counts as within it: metres per metre from the camera (orthographic:
// metres).
const float ownPlaneSlack = 5e-4;

// ownPlane: the plane that the ray starts from, as planeOnScreen gives it.
MarchRay makeMarchRay(vec3 originW, vec3 directionW, vec4 ownPlane, MarchView view) {
    ownPlane.w += 0.5 * dot(ownPlane.xy, view.pixel) - ownPlaneSlack;  // at the pixel's centre
    ownPlane.xy *= view.pixel;
    return MarchRay(originW, directionW, view.worldToClip * vec4(originW, 1.0),
                    view.worldToClip * vec4(directionW, 0.0), dot(view.viewPlane, vec4(originW, 1.0)),
                    dot(view.viewPlane.xyz, directionW), ownPlane);
}

// The depth buffer at the ray's position after t metres.
struct MarchSample {
    bool onScreen;
    ivec2 pixel;
    float depth;
    float behind;     // metres along the view by which the ray is behind the surface; negative: in front
    float thickness;  // metres along the view
    bool hittable;    // neither sky, nor in or below the plane that the ray starts from
};

// Surfaces in the ray's own plane or below it cannot be hit. Without this test, rays would self-intersect surfaces at
// grazing angles, because one depth stands for the whole width of a pixel. (Interpolated depth would also prevent that,
// but erodes half a pixel of every silhouette.) The sky cannot be hit either.
bool isHittable(MarchRay ray, ivec2 pixel, float depth) {
    return depth > 0.0 && dot(ray.ownPlane, vec4(vec2(pixel), depth, 1.0)) > 0.0;
}

// Whether a point at this view distance is no farther than the surface with this depth. Fractions are compared by
// cross-multiplying: this runs at every step, and division is slow on CPUs.
bool isInFrontOf(float viewDistance, float depth, MarchView view) {
    return viewDistance * (view.depthToDistance.z + view.depthToDistance.w * depth) <=
           view.depthToDistance.x + view.depthToDistance.y * depth;
}

// Assumed thickness, in metres along the view, of the surface that the pixel shows at view distance `front`.
float thicknessAt(ivec2 pixel, float front, MarchOptions o, MarchView view) {
    if (o.secondLayer) {
        float back = loadBackDepth(pixel);
        if (back > 0.0) {
            return depthToViewDistance(back, view.depthToDistance) - front;
        }
    }
    return o.thickness;
}

// Without branches: on CPUs each would write all that it changes to memory.
MarchSample sampleAt(MarchRay ray, float t, MarchOptions o, MarchView view) {
    vec4 clip = ray.clipStart + t * ray.clipStep;
    vec2 at = (clip.xy * (1.0 / clip.w)) * (0.5 * view.size) + 0.5 * view.size;
    MarchSample s;
    s.onScreen = clip.w > 0.0 && clip.z <= clip.w && all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, view.size));
    s.pixel = clamp(ivec2(at), ivec2(0), ivec2(view.size) - 1);
    s.depth = loadDepth(s.pixel);
    float front = depthToViewDistance(s.depth, view.depthToDistance);
    s.behind = ray.viewDistanceStart + t * ray.viewDistanceStep - front;
    s.thickness = thicknessAt(s.pixel, front, o, view);
    s.hittable = s.onScreen && isHittable(ray, s.pixel, s.depth);
    return s;
}

// Refines a hit (`behindHit` metres behind the surface) whose previous sample was in front of it (`before` metres along
// the ray, -`behindBefore` in front): o.binarySteps bisections, then linear interpolation (similar triangles).
MarchResult refineHit(MarchResult hit, float before, float behindBefore, float behindHit, MarchRay ray, MarchOptions o,
                      MarchView view) {
    for (uint i = 0u; i < o.binarySteps; ++i) {
        float middle = 0.5 * (before + hit.distance);
        MarchSample s = sampleAt(ray, middle, o, view);
        ++hit.steps;
        if (s.onScreen && s.hittable && s.behind > 0.0) {
            hit.pixel = s.pixel;
            hit.distance = middle;
            behindHit = s.behind;
        } else {
            before = middle;
            behindBefore = s.hittable ? s.behind : 0.0;
        }
    }
    if (o.interpolate && behindHit > behindBefore) {
        float cut = mix(before, hit.distance, -behindBefore / (behindHit - behindBefore));
        MarchSample s = sampleAt(ray, cut, o, view);
        ++hit.steps;
        if (s.onScreen && s.hittable) {  // not the sky, nor the ray's own plane
            hit.pixel = s.pixel;
            hit.distance = cut;
        }
    }
    return hit;
}

#endif
