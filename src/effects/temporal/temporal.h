// Temporal antialiasing (TAA): the mean of the last frames, each with its own subpixel jitter, as far as the history is
// still valid. Shared by C++ and GLSL.
//
// Each pixel is reprojected (by the motion of the nearest surface in its neighbourhood, so that edges move with the
// foreground), reads the history there (Catmull-Rom, to stay sharp), clips it to the local distribution of this frame's
// pixels (history clip), and blends in this frame with a weight of one over the history length.
// Disoccluded surfaces start with an empty history: each pixel keeps the distance and the object motion of the surface
// it showed, and surfaces that start to move mark where they were. Where the light of a static surface (its radiance
// without the texture) gets brighter or darker over frames, the history is scaled alike, so that its detail is kept.
// Where that light is also uneven, or was, a shadow edge has moved, and the pixel's history is reset.
// The sky of a moving camera is filtered over each pixel, without history. Frames may be smaller than the output
// (temporal upscaling): the jitter then brings samples to all of the output's pixels in turn. At rest, a pixel's mean
// takes only samples that lie in its own area, so that it converges to the result at full resolution. Until it has such
// a sample, and in motion, it takes the samples around it, weighted by a Gaussian of their distance, which is also
// their weight in the mean. (Karis, High Quality Temporal Supersampling, SIGGRAPH 2014: jitter, clipping in YCoCg,
// tone-compressed; Salvi, An Excursion in Temporal Supersampling, GDC 2016: limits from local mean and variance;
// Jimenez, Filmic SMAA: Sharp Morphological and Temporal Antialiasing, SIGGRAPH 2016: Catmull-Rom without its corners;
// Yang, Liu and Salvi, A Survey of Temporal Antialiasing Techniques, Eurographics 2020: upsampling by sample distance.)
#ifndef REFLET_EFFECTS_TEMPORAL_H
#define REFLET_EFFECTS_TEMPORAL_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define TEMPORAL_SETTINGS(VALUE, SWITCH, CHOICE)                                                                       \
    SWITCH(enabled, 0,                                                                                                 \
           "Temporal antialiasing (TAA) over frames (--frames), with subpixel jitter. Ignored if accumulate.enabled, " \
           "which antialiases by itself.")                                                                             \
    VALUE(uint, frames, 32, 1, 1024,                                                                                   \
          "Maximum history length where the image does not move, in frames. More: smoother edges, slower reaction to " \
          "changes. Where nothing changes at all, histories grow beyond it.")                                          \
    VALUE(uint, framesInMotion, 8, 1, 1024,                                                                            \
          "Maximum history length where the image moves by a quarter pixel per frame or faster. More: smoother; "      \
          "fewer: sharper.")                                                                                           \
    VALUE(float, clip, 1.0, 0.0, 16.0,                                                                                 \
          "History clip (variance clipping): maximum difference of the history from the pixels around it, in "         \
          "standard deviations. Lower: less ghosting, more flicker. 0: off, as after some frames at rest.")            \
    SWITCH(reflections, 1,                                                                                             \
           "Follow what smooth surfaces show of other things where that is most of their light, rather than the "      \
           "surface. Off: moving reflections leave trails.")                                                           \
    VALUE(float, scale, 1.0, 0.25, 1.0,                                                                                \
          "Temporal upscaling: the share of the picture's width and height at which frames are rendered; their mean "  \
          "has full size. 0.5: a quarter of the cost of a frame, and twice as many frames until all is sharp.")
SETTINGS(TemporalSettings, TEMPORAL_SETTINGS)

// Number of frames for which the light of a change may still spread: by then each output pixel has been sampled twice.
const uint framesThatFollow = 8;

// Vertically adjacent pixels per thread, which share their neighbourhood loads.
const uint temporalColumn = 4;

struct TemporalParams {
    mat4 toPrevious;  // clip space to the last frame's clip space, for static surfaces
    TemporalSettings settings;
    uvec2 size;
    vec2 jitter;           // this frame's subpixel jitter, in its pixels
    vec2 jitterChange;     // ViewParams::jitterChange, uv
    uint frame;            // counts up; decorrelates dithering between frames
    uint hasPrevious;      // 1: the history holds the last frame
    uint mayChange;        // 1: something has changed in the last framesThatFollow frames
    uint skyIsFixed;       // 1: where depth is 0, only camera motion changes the image
    uint resized;          // 1: the last frame had another size, and so neighbourhoods of another size
    float exposureChange;  // ViewParams::exposureChange
};

struct TemporalUpscaleParams {
    TemporalSettings settings;
    uvec2 size;   // this frame's size, pixels
    vec2 ratio;   // this frame's size over the output's
    vec2 jitter;  // this frame's subpixel jitter, in its pixels
    uint frame;   // as in TemporalParams
    float exposureChange;
};

struct TemporalSkyParams {
    ViewParams view;  // this frame's view
    vec2 ratio;       // as in TemporalUpscaleParams
    vec2 jitter;
    float frames;  // history length to write
};

SHARED_END

#ifdef __cplusplus

#include "effects/environment/environment_light.h"
#include "effects/gbuffer/gbuffer.h"
#include "gpu/pass_list.h"

namespace reflet {

/// depth, motion: those of the surface that the radiance moves with; motion without jitter. radiance: RGBA16F, rendered
/// with subpixel jitter (jitter.h), may contain NaN and infinity. view: this frame's; the sky is reprojected with it.
/// coverage: optional, red: share of each pixel that surfaces cover, 0 to 1; radiance is premultiplied by it.
/// outputSize: at least radiance's size; 0: the same. jitter: this frame's, in its pixels. reactive: reactive mask,
/// red: share of the history to discard, 0 to 1; none: 0. baseColor: as in GBuffer, so that textures do not hide
/// changes of light; none: they may. mixesSizes: the history has samples of frames of another size. Then frames of the
/// output's size are also added as in upscaling, because the history clip for one size would reject samples of another.
/// sky: the environment, if it alone is seen where depth is 0; it must live until the call returns.
struct TemporalInputs {
    gpu::Image depth;
    gpu::Image motion;
    gpu::Image radiance;
    gpu::Image coverage;
    const ViewParams& view;
    uvec2 outputSize{};
    vec2 jitter{};
    const EnvironmentLight* sky = nullptr;
    gpu::Image reactive{};
    gpu::Image baseColor{};
    bool mixesSizes = false;
};

struct TemporalImages {
    gpu::Image mean;      ///< RGBA16F: radiance, finite and at least 0, and history length;
                          ///< at the output's size
    gpu::Image coverage;  ///< R32F, averaged with the same weights as the radiance; none if none was given
};

/// The histories of temporal().
struct TemporalStore {
    gpu::HistoryImage mean{"temporal"};
    gpu::HistoryImage deviations{"temporal_deviations"};
    gpu::HistoryImage coverage{"temporal_coverage"};
    gpu::HistoryImage changes{"temporal_changes"};
    gpu::HistoryImage seen{"temporal_seen"};
    gpu::HistoryImage left{"temporal_left"};
};

TemporalImages temporal(gpu::PassList& f, TemporalStore& own, const TemporalInputs& in,
                        const TemporalSettings& settings);

}  // namespace reflet
#endif

#endif
