// The first source of the chain: rays marched through what the camera sees. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_TRACE_SCREEN_H
#define REFLET_RENDER_TRACE_SCREEN_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

#define TRACE_METHODS(OPTION)          \
    OPTION(TraceMethod, linear, 0)     \
    OPTION(TraceMethod, halving, 1)    \
    OPTION(TraceMethod, fixedPoint, 2) \
    OPTION(TraceMethod, dda, 3)        \
    OPTION(TraceMethod, exhaustive, 4) \
    OPTION(TraceMethod, hiz, 5)
CHOICES(TraceMethod, TRACE_METHODS)

#define HIT_LIGHTS(OPTION)      \
    OPTION(HitLight, direct, 0) \
    OPTION(HitLight, previous, 1)
CHOICES(HitLight, HIT_LIGHTS)

#define TRACE_SCREEN_SETTINGS(VALUE, SWITCH, CHOICE)                                                                   \
    CHOICE(TraceMethod, method, hiz,                                                                                   \
           "How rays find what they hit; linear: fixed steps in the world; halving: steps halved before what they "    \
           "would go behind; fixedPoint: the distance is replaced by that of what the screen shows; dda: steps of "    \
           "whole pixels; exhaustive: every pixel that the ray crosses; hiz: the same pixel by hierarchical depth.")   \
    VALUE(float, step, 0.15, 0.001, 100.0,                                                                             \
          "Length of a step in metres (linear), of the first (halving), first distance (fixedPoint).")                 \
    VALUE(float, smallestStep, 0.01, 0.0001, 10.0, "Metres; halving ends below it, fixedPoint when it moves by less.") \
    VALUE(float, stride, 1.0, 1.0, 64.0, "Pixels of a step of dda.")                                                   \
    VALUE(float, maxDistance, 1000.0, 0.01, 100000.0, "How far rays go in metres (dda, exhaustive, hiz).")             \
    VALUE(uint, maxSteps, 128, 1, 4096,                                                                                \
          "Steps a ray may take (exhaustive: all it needs); one that has taken them all has missed.")                  \
    VALUE(float, thickness, 0.3, 0.001, 1000.0, "How thick every surface is taken to be, in metres along the view.")   \
    SWITCH(rejectFacingAway, 0, "A ray that meets the far side of what the screen shows has missed.")                  \
    SWITCH(jitter, 1, "Start each ray at a random part of its first step: bands become grain.")                        \
    CHOICE(HitLight, light, direct,                                                                                    \
           "What a hit brings: this frame's direct light, or the last frame's whole picture (further bounces).")
SETTINGS(TraceScreenSettings, TRACE_SCREEN_SETTINGS)

struct TraceScreenParams {
    ViewParams view;
    TraceScreenSettings settings;
    uint firstRay;
    uint previousValid;  // 0: there is no last frame
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/bounce/rays.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// Answers rays that hit what the screen shows with the light there: `direct` of this frame (RGBA16F), or the last
/// frame's `lit.previous`, found by the hit's own motion. Hands on the others. pyramid (makePyramid): for hiz only.
void traceScreen(gpu::Frame& f, Rays& rays, const GBuffer& g, gpu::Image pyramid, gpu::Image direct,
                 const gpu::History& lit, const ViewParams& view, const TraceScreenSettings& settings);

}  // namespace reflet
#endif

#endif
