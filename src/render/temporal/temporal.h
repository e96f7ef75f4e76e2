// Temporal antialiasing: the picture's mean over the last frames, each of which looked through another place in the
// pixel, as far as they still hold. Shared by C++ and GLSL.
//
// Each pixel finds where it was (by the motion of the nearest surface around it, so that edges move with what is in
// front), reads the mean there (Catmull-Rom, so that it stays sharp), pulls it to what the pixels around it show now if
// it is too far from that, and adds this frame to it with a weight of one over the number of frames in the mean.
// (Karis, High Quality Temporal Supersampling, SIGGRAPH 2014: jitter, clipping in YCoCg, tone-compressed;
// Salvi, An Excursion in Temporal Supersampling, GDC 2016: limits from local mean and variance;
// Jimenez, Filmic SMAA: Sharp Morphological and Temporal Antialiasing, SIGGRAPH 2016: Catmull-Rom without its corners.)
#ifndef REFLET_RENDER_TEMPORAL_H
#define REFLET_RENDER_TEMPORAL_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

#define TEMPORAL_SETTINGS(VALUE, SWITCH, CHOICE)                                                                       \
    SWITCH(enabled, 0,                                                                                                 \
           "Temporal antialiasing (TAA) over frames (--frames), with subpixel jitter. Ignored if accumulate.enabled, " \
           "which antialiases by itself.")                                                                             \
    VALUE(uint, frames, 32, 1, 1024,                                                                                   \
          "Maximum history length where nothing moves, in frames. More: smoother edges, slower reaction to changes.")  \
    VALUE(uint, framesInMotion, 8, 1, 1024,                                                                            \
          "Maximum history length where the image moves by a quarter pixel per frame or faster. More: smoother; "      \
          "fewer: sharper.")                                                                                           \
    VALUE(float, clip, 1.0, 0.0, 16.0,                                                                                 \
          "History clip (variance clipping): maximum difference of the history from the pixels around it, in "         \
          "standard deviations. Lower: less ghosting, more flicker.")
SETTINGS(TemporalSettings, TEMPORAL_SETTINGS)

// Pixels below one another that a thread makes: they share what they read of their neighbours.
const uint temporalColumn = 4;

struct TemporalParams {
    mat4 skyToPrevious;  // clip space of what lies at infinity, to that of the last frame
    TemporalSettings settings;
    uvec2 size;
    uint frame;        // counts up; decorrelates the rounding of successive frames
    uint hasPrevious;  // 1: the history holds the last frame
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// view: that it was drawn with, whose change the sky follows. radiance: RGBA16F, of a view that looked through a place
/// in the pixel (jitter.h); motion: without jitter. Anything is allowed in it; what comes out is finite and at least 0.
/// Gives RGBA16F: radiance, and the number of frames in it.
gpu::Image temporal(gpu::Frame& f, const GBuffer& g, gpu::Image radiance, const TemporalSettings& settings,
                    const ViewParams& view);

}  // namespace reflet
#endif

#endif
