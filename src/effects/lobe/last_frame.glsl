// Reprojection of visible surfaces: their own motion, and whether the last frame showed them. The includer declares
// params.view and the images motion and previousLit.
#ifndef REFLET_LAST_FRAME_GLSL
#define REFLET_LAST_FRAME_GLSL

#include "shaders/object_motion.glsl"

const float sameDistance = 0.02;  // tolerance for the distance of a reprojected surface, relative

// Object motion since the last frame, without the camera's, of the visible point p [m].
vec3 displacementAt(ivec2 pixel, vec3 p) {
    return objectDisplacement(p, pixelToUv(pixel, params.view.pixel), texelFetch(motion, pixel, 0).xyz,
                           params.view.previousWorldToClip, params.view.viewPlane.xyz);
}

// uv of the pixel's surface in the last frame's image.
vec2 uvInLastFrame(ivec2 pixel, vec2 uv) { return uv + params.view.jitterChange - texelFetch(motion, pixel, 0).xy; }

// Whether the last frame showed the same surface at uv: no disocclusion. p, n: point and geometric normal of the pixel
// now.
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
