// Screen-space ray tracing (SSR, SSGI): rays marched through the camera's depth buffer; and, by the same pass, planar
// reflections: rays marched through the mirrored camera's depth buffer. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_TRACE_SCREEN_H
#define REFLET_EFFECTS_TRACE_SCREEN_H

#include "base/shared.h"
#include "effects/planar/planar.h"
#include "effects/view.h"

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

#define RAY_COMPACTIONS(OPTION)      \
    OPTION(RayCompaction, device, 0) \
    OPTION(RayCompaction, never, 1)  \
    OPTION(RayCompaction, always, 2)
CHOICES(RayCompaction, RAY_COMPACTIONS)

#define HIT_LIGHTS(OPTION)      \
    OPTION(HitLight, direct, 0) \
    OPTION(HitLight, lit, 1)    \
    OPTION(HitLight, previous, 2)
CHOICES(HitLight, HIT_LIGHTS)

// What hits read of surfaces with materialFlagEmitter.
#define EMITTERS_AT_HITS(OPTION)    \
    OPTION(EmittersAtHits, all, 0)  \
    OPTION(EmittersAtHits, none, 1) \
    OPTION(EmittersAtHits, notHighlighted, 2)  // what they emit, but for rays with Ray.highlighted
CHOICES(EmittersAtHits, EMITTERS_AT_HITS)

// Metals at which rays count as misses, as their reflection on screen is valid for the camera's direction only.
#define METALS_LEFT_OUT(OPTION)       \
    OPTION(MetalsLeftOut, none, 0)    \
    OPTION(MetalsLeftOut, mirrors, 1) \
    OPTION(MetalsLeftOut, smooth, 2)  // smoother than roughestView
CHOICES(MetalsLeftOut, METALS_LEFT_OUT)

#define TRACE_SCREEN_SETTINGS(VALUE, SWITCH, CHOICE)                                                                   \
    SWITCH(enabled, 1,                                                                                                 \
           "Screen-space ray tracing (SSR, SSGI): march rays through the depth buffer. Off: rays go straight to the "  \
           "next source.")                                                                                             \
    CHOICE(TraceMethod, method, hiz,                                                                                   \
           "Ray march algorithm. linear: fixed steps in world space. halving: the step is halved before it would "     \
           "pass behind a surface. fixed_point: iterate the distance to that of the depth sample. dda: steps of "      \
           "whole pixels in screen space. exhaustive: every pixel along the ray, as a reference. hiz: the same "       \
           "result by hierarchical depth (Hi-Z), usually fastest.")                                                    \
    VALUE(float, step, 0.15, 0.001, 100.0,                                                                             \
          "Step length in metres (linear), initial step (halving), initial distance (fixed_point). Smaller: fewer "    \
          "missed objects, more steps for the same distance.")                                                         \
    VALUE(float, minStep, 0.01, 0.0001, 10.0,                                                                          \
          "Metres. halving stops when its step is shorter than this, fixed_point when the distance changes by less.")  \
    VALUE(float, stride, 1.0, 1.0, 64.0, "Pixels per step (dda). More: faster, but thin objects are missed.")          \
    VALUE(uint, firstSteps, 2, 0, 64, "Single-pixel steps that hiz takes before it moves to coarser levels.")          \
    VALUE(float, maxDistance, 1000.0, 0.01, 100000.0,                                                                  \
          "Maximum ray length in metres. Shorter: fewer steps, but distant reflections are missing.")                  \
    VALUE(uint, maxSteps, 128, 1, 4096,                                                                                \
          "Maximum steps per ray; a ray that runs out of steps is a miss. More: longer reach, higher cost. "           \
          "exhaustive ignores it.")                                                                                    \
    CHOICE(RayCompaction, compaction, device,                                                                          \
           "Whether rays that have not ended after 32 and 64 steps are collected, and go on side by side (hiz). The "  \
           "picture is the same. device: on GPUs, whose waves of 32 or 64 rays wait for the longest; on CPU devices "  \
           "lists cost more than they save. never, always: for comparison.")                                           \
    SWITCH(jitter, 1,                                                                                                  \
           "Start each ray at a random fraction of its first step (linear, halving, dda): banding becomes noise.")     \
    VALUE(uint, binarySteps, 0, 0, 16,                                                                                 \
          "Binary search steps that refine a hit (linear, halving, and dda with a stride above 1). More: less "        \
          "stair-stepping.")                                                                                           \
    SWITCH(interpolate, 0,                                                                                             \
           "Refine a hit by linear interpolation between the last two samples (linear, halving, and dda with a "       \
           "stride above 1).")                                                                                         \
    VALUE(float, thickness, 0.3, 0.001, 1000.0,                                                                        \
          "Assumed thickness of every surface in metres along the view. Too small: rays slip through objects; too "    \
          "large: false hits behind them.")                                                                            \
    CHOICE(ThicknessMode, thicknessMode, constant,                                                                     \
           "How thick surfaces are taken to be. constant: `thickness`. step: `thickness` plus the depth that one "     \
           "step covers (linear, halving). second_layer: up to the back face, from a second depth layer, where there " \
           "is one; draws the scene's back faces as well.")                                                            \
    SWITCH(rejectBackfaces, 1,                                                                                         \
           "Treat a hit on the far side of a visible surface, or on its side behind the silhouette, as a miss, "       \
           "because the screen does not show it; and, where scene rays follow and thickness_mode is constant, any "    \
           "hit of a ray that passed behind a surface, which may have stopped it.")                                    \
    VALUE(float, edgeFade, 0.0, 0.0, 0.5,                                                                              \
          "Fade out hits this close to the screen edge, as a fraction of the screen's size. Hides hard cut-offs of "   \
          "reflections.")                                                                                              \
    VALUE(float, distanceFade, 0.0, 0.0, 1.0, "Fade out hits in this last fraction of the maximum ray length.")        \
    VALUE(float, cameraFade, 0.0, 0.0, 1.0,                                                                            \
          "Fade out rays that point back to the camera, where 1 - cos(angle) is below this value.")                    \
    CHOICE(HitLight, light, lit,                                                                                       \
           "Radiance taken at a hit. direct: direct light of this frame (one bounce). lit: the same; reflections "     \
           "also get this frame's diffuse GI. previous: the whole previous frame, reprojected, which adds further "    \
           "bounces over time.")                                                                                       \
    SWITCH(countSteps, 0, "Count the depth samples of each ray; `--show steps` switches this on by itself.")           \
    SWITCH(countHits, 0,                                                                                               \
           "Keep the mean distance of the rays that hit something apart from the others; `--show hit_distance` "       \
           "switches this on by itself. Slower; the picture does not change.")
SETTINGS(TraceScreenSettings, TRACE_SCREEN_SETTINGS)

// The view that rays are traced in, as the specialization constant `through`.
const uint throughScreen = 0;
const uint throughMirror = 1;        // a mirrored camera's view: ray march
const uint throughMirrorLookup = 2;  // the planar image at the ray's origin, no march
const uint throughMirrorCamera = 3;  // a camera image mapped onto the mirror

struct TraceScreenParams {
    ViewParams own;   // of the surfaces that rays start from
    ViewParams view;  // in which they are traced
    MirrorParams mirror;
    TraceScreenSettings settings;
    float longest;   // maximum ray length, metres
    uint firstStep;  // march_phases.glsl
    uint endStep;
    uint firstRay;
    uint previousValid;  // 0: there is no last frame
};

SHARED_END

#ifdef __cplusplus

#include "effects/gbuffer/gbuffer.h"
#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

#include <string>
#include <vector>

namespace reflet {

/// The buffers that rays are marched through, and the light at hits.
struct ScreenImages {
    GBuffer g;
    ViewParams view;
    gpu::Image backDepth;  ///< from drawBackDepth; only if settings.thicknessMode is second_layer
    gpu::Image pyramid;    ///< from makePyramid; only for hiz
    gpu::Image light;      ///< RGBA16F: of this frame
    gpu::History lit;      ///< of the last frame, reprojected by the hit's motion
    gpu::Image
        lightMips;  ///< from makeLightMips, of the image that hits read; blurs the light at hits of cones (Ray.spread)
    bool certainNext = false;  ///< misses go on to a source that finds the actual hit
    MetalsLeftOut metalsLeftOut = MetalsLeftOut::none;
    EmittersAtHits emitters = EmittersAtHits::all;
};

/// Binds what screen_light.glsl reads and the back depth, and sets its constants. params: `view` and `previousValid`
/// are set here, `longest` is bounded by the settings.
gpu::ComputePass& bindScreenLight(gpu::PassList& f, gpu::ComputePass& pass, const ScreenImages& seen,
                                  TraceScreenParams params);

/// The same for screen_hit.glsl. imageMotion: of Rays; may be none.
gpu::ComputePass& bindScreen(gpu::PassList& f, gpu::ComputePass& pass, const ScreenImages& seen,
                             const TraceScreenParams& params, gpu::Image imageMotion);

/// A pass over rays that have made `first` steps, until they have made `end`.
struct MarchPhase {
    uint32_t first = 0;
    uint32_t end = 0;
    gpu::BufferView unfinished;  ///< list of the rays; none: they have not begun
    gpu::BufferView longer;      ///< empty list for those that do not end in it; none: all do
};

/// Whether rays that have not ended are collected, by the settings and the device.
bool compactsRays(const gpu::Context& context, const TraceScreenSettings& settings);

/// The passes that march `rays` rays, by the settings and the device.
std::vector<MarchPhase> marchPhases(gpu::PassList& f, const TraceScreenSettings& settings, VkDeviceSize rays);

/// Suffix of the names of passes that continue a march.
std::string nameOf(const MarchPhase& phase);

/// Binds what march_phases.glsl declares, but for its part of the params. spare: buffers to bind in place of lists that
/// the phase has not: to read, to write.
gpu::ComputePass& bindMarchPhase(gpu::ComputePass& pass, const MarchPhase& phase, gpu::BufferView spareToRead,
                                 gpu::BufferView spareToWrite);

/// Gives rays that hit a visible surface the light there; the others stay in rays.waiting. longest: maximum length of
/// the lobe's rays [m].
void traceScreen(gpu::PassList& f, Rays& rays, const ScreenImages& screen, const TraceScreenSettings& settings,
                 float longest);

/// One planar reflection.
struct PlanarView {
    ScreenImages seen;  ///< by the mirrored camera (traced, lookup), the camera itself (duplicate), or the mirror's own
                        ///< camera (camera); `lit` is not used
    MirrorParams mirror;
    PlanarForm form = PlanarForm::traced;
};

/// Gives rays that start on the mirror the light of its planar view; misses stay in rays.waiting.
void traceMirror(gpu::PassList& f, Rays& rays, const PlanarView& mirror, const TraceScreenSettings& settings,
                 float longest);

}  // namespace reflet
#endif

#endif
