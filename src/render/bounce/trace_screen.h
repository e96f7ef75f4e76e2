// The first source of the chain: rays marched through what the camera sees; and, by the same passes, the planar views:
// rays marched through what the mirrored camera sees. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_TRACE_SCREEN_H
#define REFLET_RENDER_TRACE_SCREEN_H

#include "base/shared.h"
#include "render/planar/planar.h"
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

#define THICKNESSES(OPTION)            \
    OPTION(ThicknessMode, constant, 0) \
    OPTION(ThicknessMode, step, 1)     \
    OPTION(ThicknessMode, secondLayer, 2)
CHOICES(ThicknessMode, THICKNESSES)

#define HIT_LIGHTS(OPTION)      \
    OPTION(HitLight, direct, 0) \
    OPTION(HitLight, lit, 1)    \
    OPTION(HitLight, previous, 2)
CHOICES(HitLight, HIT_LIGHTS)

#define TRACE_SCREEN_SETTINGS(VALUE, SWITCH, CHOICE)                                                                 \
    SWITCH(enabled, 1, "Ask what the camera sees; off: rays go on to the next source at once.")                      \
    CHOICE(TraceMethod, method, hiz,                                                                                 \
           "How rays find what they hit; linear: fixed steps in the world; halving: steps halved before what they "  \
           "would go behind; fixed_point: the distance is replaced by that of what the screen shows; dda: steps of " \
           "whole pixels; exhaustive: every pixel that the ray crosses; hiz: the same pixel by hierarchical depth.") \
    VALUE(float, step, 0.15, 0.001, 100.0,                                                                           \
          "Length of a step in metres (linear), of the first (halving), first distance (fixed_point).")              \
    VALUE(float, minStep, 0.01, 0.0001, 10.0, "Metres; halving ends below it, fixed_point when it moves by less.")   \
    VALUE(float, stride, 1.0, 1.0, 64.0, "Pixels of a step of dda.")                                                 \
    VALUE(uint, firstSteps, 2, 0, 64, "Single pixels that hiz visits before it tries larger cells.")                 \
    VALUE(float, maxDistance, 1000.0, 0.01, 100000.0, "How far rays go in metres.")                                  \
    VALUE(uint, maxSteps, 128, 1, 4096,                                                                              \
          "Steps a ray may take (exhaustive: all it needs); one that has taken them all has missed.")                \
    SWITCH(jitter, 1, "Start each ray at a random part of its first step: bands become grain.")                      \
    VALUE(uint, binarySteps, 0, 0, 16, "Halvings of the last step after a hit (linear, halving, dda).")              \
    SWITCH(interpolate, 0, "Place a hit between the last two samples, by similar triangles (linear, halving, dda).") \
    VALUE(float, thickness, 0.3, 0.001, 1000.0, "How thick every surface is taken to be, in metres along the view.") \
    CHOICE(ThicknessMode, thicknessMode, constant,                                                                   \
           "constant: the thickness; step: more by as much as a step goes along the view (linear, halving); "        \
           "second_layer: up to the back face, drawn once more, where there is one.")                                \
    SWITCH(rejectBackfaces, 1, "A ray that meets the far side of what the screen shows has missed.")                 \
    VALUE(float, edgeFade, 0.0, 0.0, 0.5, "Hits this near the screen's edges fade out: a share of its size.")        \
    VALUE(float, distanceFade, 0.0, 0.0, 1.0, "Hits in this last part of maxDistance fade out.")                     \
    VALUE(float, cameraFade, 0.0, 0.0, 1.0,                                                                          \
          "Rays toward the camera fade out, where 1 - the angle's cosine is less than this.")                        \
    CHOICE(HitLight, light, lit,                                                                                     \
           "What a hit brings: this frame's direct light; lit: and, to reflections, this frame's diffuse light; "    \
           "previous: the last frame's whole picture (further bounces).")                                            \
    SWITCH(countSteps, 0, "Keep how many depth samples each ray took (--show steps does so by itself).")
SETTINGS(TraceScreenSettings, TRACE_SCREEN_SETTINGS)

// What rays are asked of, as the specialization constant `through`.
const uint throughScreen = 0;
const uint throughMirror = 1;        // a mirrored camera's picture: marched
const uint throughMirrorLookup = 2;  // any camera's picture, where it shows the ray's own start
const uint throughMirrorCamera = 3;  // a picture that lies on the mirror

struct TraceScreenParams {
    ViewParams own;   // of the surfaces that rays leave
    ViewParams view;  // that they are traced through
    MirrorParams mirror;
    TraceScreenSettings settings;
    float longest;  // metres: no ray goes farther
    uint firstRay;
    uint previousValid;  // 0: there is no last frame
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/bounce/rays.h"
#include "render/gbuffer/gbuffer.h"

#include <string>

namespace reflet {

/// What rays are traced through, and the light that they find.
struct ScreenImages {
    GBuffer g;
    ViewParams view;
    gpu::Image backDepth;  ///< drawBackDepth; only where settings.thicknessMode is second_layer
    gpu::Image pyramid;    ///< makePyramid; for hiz only
    gpu::Image light;      ///< RGBA16F: of this frame
    gpu::History lit;      ///< of the last frame, found by the hit's own motion
    gpu::Image lightMips;  ///< makeLightMips, of the image that hits take their light from; where rays stand for all of
                           ///< the lobe (Ray.spread), their hits' light is blurred
};

/// Answers rays that hit what the screen shows with the light there. Hands on the others. longest: of the lobe's rays
/// [m].
void traceScreen(gpu::Frame& f, Rays& rays, const ScreenImages& screen, const TraceScreenSettings& settings,
                 float longest);

/// What a mirror shows.
struct PlanarView {
    std::string name;   ///< another for each of a frame's
    ScreenImages seen;  ///< by the mirrored camera (traced, lookup), from the camera itself (duplicate), by the
                        ///< mirror's (camera); `lit` is not used
    MirrorParams mirror;
    PlanarForm form = PlanarForm::traced;
};

/// Answers rays that start on the mirror with what its view shows; what that cannot say, it hands on.
void traceMirror(gpu::Frame& f, Rays& rays, const PlanarView& mirror, const TraceScreenSettings& settings,
                 float longest);

}  // namespace reflet
#endif

#endif
