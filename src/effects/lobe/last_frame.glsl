// Reprojection of visible surfaces: their own motion, and whether the last frame showed them. The includer declares
// params.view and the images motion and previousLit.
#ifndef REFLET_LAST_FRAME_GLSL
#define REFLET_LAST_FRAME_GLSL

#include "shaders/object_motion.glsl"

const float sameDistance = 0.02;  // tolerance for the distance of a reprojected surface, relative
// Just outside the last picture, its edge shows what is there well enough, if that is about as far away: as shares of
// the picture's size, and of the distance.
const float besides = 0.05;
const float sameDistanceBesides = 0.15;

// Object motion since the last frame, without the camera's, of the visible point p [m].
vec3 displacementAt(ivec2 pixel, vec3 p) {
    return objectDisplacement(p, pixelToUv(pixel, params.view.pixel), texelFetch(motion, pixel, 0).xyz,
                           params.view.previousWorldToClip, params.view.viewPlane.xyz);
}

// uv of the pixel's surface in the last frame's image.
vec2 uvInLastFrame(ivec2 pixel, vec2 uv) { return uv + params.view.jitterChange - texelFetch(motion, pixel, 0).xy; }

// Whether the last frame showed the same surface at uv: no disocclusion. uv may lie a little outside of the picture, and
// becomes the nearest in it. p, n: point and geometric normal of the pixel now.
bool wasShown(inout vec2 uv, ivec2 pixel, vec3 p, vec3 n) {
    vec2 inside = clamp(uv, 0.5 * params.view.pixel, 1.0 - 0.5 * params.view.pixel);
    vec2 outside = abs(uv - inside);
    if (max(outside.x, outside.y) > besides) {
        return false;
    }
    bool left = any(greaterThan(outside, params.view.pixel));
    float tolerance = left ? sameDistanceBesides : sameDistance;
    uv = inside;
    vec4 before = params.view.previousWorldToClip * vec4(p - displacementAt(pixel, p), 1.0);
    float expected = depthToViewDistance(before.z / before.w, params.view.depthToDistance);
    float pixelWidth = params.view.pixelAngle * (params.view.eye.w > 0.0 ? expected : 1.0);
    float facing = max(abs(dot(n, directionToEye(p, params.view.eye))), 0.05);
    float slack = tolerance * expected + 2.0 * pixelWidth / facing;
    float kept = imageLoad(previousLit, ivec2(uv * params.view.size)).a;
    return abs(min(expected, largestHalf) - kept) <= slack;
}

#endif
