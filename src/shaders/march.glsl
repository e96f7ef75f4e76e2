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

// The depth between pixel centres. Depth is linear across the screen on a plane, so this is exact there.
float loadDepthBilinear(vec2 uv, vec2 size) {
    vec2 at = uv * size - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 f = at - vec2(corner);
    ivec2 low = clamp(corner, ivec2(0), ivec2(size) - 1);
    ivec2 high = clamp(corner + 1, ivec2(0), ivec2(size) - 1);
    float top = mix(loadDepth(low), loadDepth(ivec2(high.x, low.y)), f.x);
    float bottom = mix(loadDepth(ivec2(low.x, high.y)), loadDepth(high), f.x);
    return mix(top, bottom, f.y);
}

// Fixed steps in the world. jitter: 0..1, what part of a step the first one is. A sample hits when it lies behind the
// surface that its pixel shows by less than `thickness` metres along the view, and behind the depth between the pixels
// too: a surface seen at a slant would else be hit by rays that have only just left it, because a pixel's one depth
// stands for all of its width (Stachowiak's double test).
// Clip coordinates and view distance are linear along the ray: one multiply-add a step each.
MarchResult marchLinear(vec3 originW, vec3 directionW, float stepLength, uint maxSteps, float thickness, float jitter,
                        MarchView view) {
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
        float behind = awayStart + t * awayStep - depthToViewDistance(loadDepth(result.pixel), view.depthToDistance);
        if (behind > 0.0 && behind < thickness) {
            float between = depthToViewDistance(loadDepthBilinear(uv, view.size), view.depthToDistance);
            if (awayStart + t * awayStep > between) {
                result.outcome = marchHit;
                break;
            }
        }
    }
    return result;
}

#endif
