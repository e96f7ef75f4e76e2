// Motion blur: the blur of a shutter that is open for a part of the time between frames, from a sharp picture, its
// depth and its motion vectors. Shared by C++ and GLSL.
//
// Motion is taken to be constant while the shutter is open, half of that time before the frame and half after it. A
// surface sweeps by its half streak to both sides of its position. Tiles store the longest half streak in them, then
// the maximum over neighbouring tiles. Along that one, a pixel gathers the surfaces that sweep over it: surfaces in
// front of it, or faster ones as near, whose half streak reaches the pixel; the share of the samples that do is their
// coverage. Along its own half streak it gathers its own surface and, past that surface's edge, what is seen behind it;
// where something else is in front, samples do not count. Tiles without motion are copied. (M. McGuire, P. Hennessy, M.
// Bukowski, B. Osman, A Reconstruction Filter for Plausible Motion Blur, I3D 2012: tile and neighbourhood maxima,
// gather by depth and velocity; J.-P. Guertin, M. McGuire, D. Nowrouzezahrai, A Fast and Stable Feature-Aware Motion
// Blur Filter, HPG 2014: two directions of samples, jittered tiles; J. Jimenez, Next Generation Post Processing in Call
// of Duty: Advanced Warfare, SIGGRAPH 2014: the share that nothing covers is the background's)
#ifndef REFLET_EFFECTS_MOTION_BLUR_H
#define REFLET_EFFECTS_MOTION_BLUR_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define MOTION_BLUR_SETTINGS(VALUE, SWITCH, CHOICE)                                                                  \
    SWITCH(enabled, 0,                                                                                               \
           "Motion blur of moving cameras and objects (sequences), after temporal antialiasing and depth of field.") \
    VALUE(float, shutter, 0.5, 0.0, 1.0,                                                                             \
          "Share of the time between frames that the shutter is open: shutter angle / 360 degrees. Longer: longer "  \
          "streaks.")                                                                                                \
    VALUE(uint, samples, 16, 2, 128,                                                                                 \
          "Samples per pixel along each of two streaks: the longest around, and the pixel's own. More: less noise, " \
          "cost grows linearly.")                                                                                    \
    VALUE(float, maxLength, 0.1, 0.005, 0.5,                                                                         \
          "Longest streak as a share of the picture's height; longer ones are cut to it. Longer: right for fast "    \
          "motion, larger tiles, so that more pixels are searched.")
SETTINGS(MotionBlurSettings, MOTION_BLUR_SETTINGS)

struct MotionBlurStreakParams {
    mat4 toPrevious;       // clip space to the last frame's clip space, of what is at rest
    vec4 depthToDistance;  // of the view
    vec2 toHalfStreak;     // from motion in uv to half streaks in pixels of the picture
    uvec2 size;            // of the depth buffer
    float longest;         // half streak [pixels of the picture]
};

struct MotionBlurTileParams {
    uvec2 from;  // size of the image that is read
    uvec2 to;    // size of the image that is written
    uvec2 step;  // of what is read from one texel to the next: (1, 0) or (0, 1)
    uint side;   // of a tile, in texels
};

struct MotionBlurGatherParams {
    uvec2 size;    // of the picture
    vec2 toDepth;  // pixels of the depth buffer per pixel of the picture
    vec2 toTiles;  // tiles per pixel of the picture
    uint samples;
    uint frame;  // decorrelates the noise of successive frames; frames at rest have the same
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

namespace reflet {

struct MotionBlurInputs {
    gpu::Image radiance;  ///< RGBA16F, R32F or RGBA32F, of the picture's size; alpha is kept
    gpu::Image depth;     ///< reversed, of this size or smaller (temporal upscaling)
    gpu::Image motion;    ///< of the depth's size: uv minus uv in the last frame, without jitter; background: not read.
                          ///< None: only the camera moves, as view.previousWorldToClip says
    const ViewParams& view;  ///< of `depth`
    MotionBlurSettings settings;
};

struct MotionBlurImages {
    gpu::Image radiance;  ///< RGBA16F of the picture's size; the input without an effect
    gpu::Image tiles;     ///< RG16F, a texel per tile: the longest half streak in it and in the tiles around [pixels of
                          ///< the picture]; none without an effect
};

/// Whether the shutter is open for any time.
bool blurs(const MotionBlurSettings& settings);

MotionBlurImages motionBlur(gpu::PassList& f, const MotionBlurInputs& in);

}  // namespace reflet
#endif

#endif
