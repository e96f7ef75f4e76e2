// Debug record of one screen-space ray march with all of its depth samples, for explanatory pictures. Shared by C++ and
// GLSL.
#ifndef REFLET_EFFECTS_RECORD_RAY_H
#define REFLET_EFFECTS_RECORD_RAY_H

#include "base/shared.h"
#include "effects/lobe/trace_screen.h"
#include "effects/view.h"

SHARED_BEGIN

// The image: texels (outcome as in march.glsl, or -1 if the pixel shows no surface; pixel; metres), (unoccluded metres,
// passed behind a surface, depth samples, back face), (confidence, its factors for edge, distance, camera), (direction,
// number of steps), (origin, 1); then, for each depth sample, (cell, level, nearest depth there).
const uint recordHead = 5;
const uint recordedSteps = 1024;  // further steps are counted, not stored

// Rays over a pixel's hemisphere, two texels each: (direction, metres), (1: it hits the screen, pixel of the hit).
const uint recordedSamples = 64;

struct RecordRayParams {
    ViewParams view;
    TraceScreenSettings settings;
    uvec2 pixel;
    uint secondLayer;
    uint certainNext;
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/trace_screen.h"
#include "gpu/recorder.h"

#include <optional>
#include <vector>

namespace reflet {

struct RayStep {
    uvec2 cell{0};         ///< in cells of its level
    uint32_t level = 0;    ///< a cell covers 2^level by 2^level pixels
    float nearest = 0.0F;  ///< reversed depth
};

enum class RayOutcome : uint8_t { hit, leftScreen, spent, hidden };

struct RecordedRay {
    RayOutcome outcome = RayOutcome::spent;
    uvec2 pixel{0};           ///< of the hit, else the last pixel visited
    float distance = 0.0F;    ///< metres
    float clear = 0.0F;       ///< metres along the ray that are known to be unoccluded
    bool lost = false;        ///< it passed behind a visible surface
    bool unseen = false;      ///< the screen does not show what was hit (isUnseen)
    float confidence = 0.0F;  ///< of the hit, 0..1: the product of the three
    float edge = 0.0F;
    float far = 0.0F;
    float camera = 0.0F;
    vec3 direction{0.0F};
    vec3 start{0.0F};
    uint32_t samples = 0;  ///< number of depth samples
    std::vector<RayStep> steps;
};

/// A diffuse ray of a pixel.
struct RecordedSample {
    vec3 direction{0.0F};   ///< unit length
    float distance = 0.0F;  ///< marched, metres
    bool hits = false;      ///< on the screen; else the next source answers
    uvec2 pixel{0};         ///< of the hit
};

struct RecordRayInputs {
    const GBuffer& g;
    gpu::Image backDepth;      ///< second depth layer, or none
    gpu::Image pyramid;        ///< of makePyramid; none: it is made
    bool certainNext = false;  ///< as in ScreenImages
};

/// Records the mirror ray of the pixel. Call recordRay while recording the frame with these images, recordedRay when
/// the frame is done; it returns nothing if the pixel shows no surface.
gpu::Readback recordRay(gpu::PassList& f, const RecordRayInputs& in, const ViewParams& view,
                        const TraceScreenSettings& settings, uvec2 pixel);
std::optional<RecordedRay> recordedRay(const gpu::Recorder& f, gpu::Readback readback);

/// Records as many diffuse rays of the pixel as recordedSamples, evenly over its cosine-weighted hemisphere: each
/// stands for the same share of its light. The pixel must show a surface for the result to mean anything.
gpu::Readback recordHemisphere(gpu::PassList& f, const RecordRayInputs& in, const ViewParams& view,
                               const TraceScreenSettings& settings, uvec2 pixel);
std::vector<RecordedSample> recordedHemisphere(const gpu::Recorder& f, gpu::Readback readback);

}  // namespace reflet
#endif

#endif
