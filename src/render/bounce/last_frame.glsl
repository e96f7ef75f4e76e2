// Of what the screen shows: how it moved by itself, and whether the last frame showed it. The includer has params.view,
// and the images motion and previousLit.
#ifndef REFLET_LAST_FRAME_GLSL
#define REFLET_LAST_FRAME_GLSL

#include "shaders/object_motion.glsl"

const float sameDistance = 0.02;  // share of its distance by which the last frame may have shown a surface elsewhere

// Since the last frame, of the point p that the pixel shows, by itself [m].
vec3 displacementAt(ivec2 pixel, vec3 p) {
    return objectDisplacement(p, pixelToUv(pixel, params.view.pixel), texelFetch(motion, pixel, 0).xyz,
                           params.view.previousWorldToClip, params.view.viewPlane.xyz);
}

// Where in the last frame's image the pixel's surface was.
vec2 uvInLastFrame(ivec2 pixel, vec2 uv) { return uv + params.view.jitterChange - texelFetch(motion, pixel, 0).xy; }

// Whether the last frame showed there what the pixel shows now: the point p with the geometric normal n.
bool wasShown(vec2 uv, ivec2 pixel, vec3 p, vec3 n) {
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThanEqual(uv, vec2(1.0)))) {
        return false;
    }
    vec4 before = params.view.previousWorldToClip * vec4(p - displacementAt(pixel, p), 1.0);
    float expected = depthToViewDistance(before.z / before.w, params.view.depthToDistance);
    float pixelWidth = params.view.pixelAngle * (params.view.eye.w > 0.0 ? expected : 1.0);
    float facing = max(abs(dot(n, directionToEye(p, params.view.eye))), 0.05);
    float slack = sameDistance * expected + 2.0 * pixelWidth / facing;
    float kept = imageLoad(previousLit, ivec2(uv * params.view.size)).a;
    return abs(min(expected, largestHalf) - kept) <= slack;
}

#endif
