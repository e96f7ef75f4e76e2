// A camera as passes see it. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_VIEW_H
#define REFLET_EFFECTS_VIEW_H

#include "base/shared.h"

SHARED_BEGIN

// Frames at rest after which histories hold nothing from before, and are no longer clipped: a history clip also cuts
// noise, and so loses energy.
const uint framesUntilSettled = 16;

// Clip space is Vulkan's with reversed depth: 1 at the near plane, 0 at infinity. uv = 0.5 + 0.5 · ndc.xy.
struct ViewParams {
    mat4 worldToClip;
    mat4 clipToWorld;
    mat4 previousWorldToClip;  // the last frame's worldToClip, with this frame's subpixel jitter; equal to worldToClip
                               // in the first frame
    mat4 paddedClipToWorld;  // clipToWorld without jitter, padded by half a pixel: covers all that jittered frames can
                             // show. Sun shadow maps are fitted to it, so that they do not change with the jitter
    vec4 eye;                // world space: the camera's position with w = 1, or (orthographic) the direction
                             // toward the camera with w = 0
    vec4 viewPlane;          // dot(viewPlane, (p, 1)): distance of a world point in front of the camera [m]
    vec4 depthToDistance;    // that distance from a depth d: (x + y d) / (z + w d)
    vec2 size;               // pixels
    vec2 pixel;              // 1 / size
    vec2 jitterChange;  // uv: this frame's subpixel jitter minus the last frame's. The surface at uv was at uv - motion
                        // + jitterChange in the last frame's images
    vec2 jitter;        // this frame's subpixel jitter, pixels: offset of the sample from the pixel centre
    float pixelAngle;   // a pixel's height at distance 1 [m/m]; orthographic: at any distance [m]
    uint frame;         // counts up; decorrelates the noise of successive frames
    uint seed;          // random seed of the rendering
    uint rest;          // frames before this one since anything changed: camera, lights, surfaces, settings. How
                        // histories use it: lighting::fitHistories
    float preExposure;  // power of two by which all radiance in images is multiplied, so that half floats hold it
    float
        exposureChange;  // factor on radiance in images of the last frame: pre-exposure now over that of the last frame
};

SHARED_END

#endif
