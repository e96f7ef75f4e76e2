// One ray through the screen and all that it looks at, for pictures that explain it. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_RECORD_RAY_H
#define REFLET_RENDER_RECORD_RAY_H

#include "base/shared.h"
#include "render/bounce/trace_screen.h"
#include "render/view.h"

SHARED_BEGIN

// The image: texels (outcome as of march.glsl, or -1: the pixel shows nothing; pixel; metres), (metres that are known
// to be clear, went behind something, depth samples, faces away), (confidence, its part for edge, distance, camera),
// (direction, number of steps), (where it starts, 1); then, for each depth that it looked at, (cell, level, nearest
// depth there).
const uint recordHead = 5;
const uint recordedSteps = 1024;  // what comes after is counted, not kept

struct RecordRayParams {
    ViewParams view;
    TraceScreenSettings settings;
    uvec2 pixel;
    uint secondLayer;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/direct_view.h"

#include <optional>
#include <vector>

namespace reflet {

struct RayStep {
    uvec2 cell{0};         ///< in cells of its level
    uint32_t level = 0;    ///< a cell has 2^level by 2^level pixels
    float nearest = 0.0F;  ///< reversed depth
};

enum class RayOutcome : uint8_t { hit, leftScreen, spent, hidden };

struct RecordedRay {
    RayOutcome outcome = RayOutcome::spent;
    uvec2 pixel{0};           ///< of the hit, else the last one
    float distance = 0.0F;    ///< metres
    float clear = 0.0F;       ///< metres, that it is known to have met nothing on
    bool lost = false;        ///< it went behind something
    bool facesAway = false;   ///< the hit shows its far side
    float confidence = 0.0F;  ///< of the hit, 0..1: the product of the three
    float edge = 0.0F;
    float far = 0.0F;
    float camera = 0.0F;
    vec3 direction{0.0F};
    vec3 start{0.0F};
    uint32_t samples = 0;  ///< depths that it looked at
    std::vector<RayStep> steps;
};

/// Records the mirror ray of the pixel. The first part is for the recording of a frame whose images these are, the
/// second for when it is done: nothing where the pixel shows no surface.
gpu::Readback recordRay(gpu::Frame& f, const ViewImages& images, const ViewParams& view,
                        const TraceScreenSettings& settings, uvec2 pixel);
std::optional<RecordedRay> recordedRay(const gpu::Frame& f, gpu::Readback readback);

}  // namespace reflet
#endif

#endif
