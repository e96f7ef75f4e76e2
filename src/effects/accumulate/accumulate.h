// Progressive accumulation: running means of the light layers over frames of the same view. Noise falls with the number
// of frames. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_ACCUMULATE_H
#define REFLET_EFFECTS_ACCUMULATE_H

#include "base/shared.h"

SHARED_BEGIN

#define ACCUMULATE_SETTINGS(VALUE, SWITCH, CHOICE)                                                              \
    SWITCH(enabled, 0,                                                                                          \
           "Progressive rendering: show the mean of all frames (--frames) since view, lights or settings last " \
           "changed. Converges to a noise-free image.")                                                         \
    SWITCH(jitter, 1, "Subpixel jitter in each frame, so that the mean is antialiased.")
SETTINGS(AccumulateSettings, ACCUMULATE_SETTINGS)

struct AccumulateParams {
    uvec2 size;
    float weight;  // of this frame: 1 / number of frames including this one
};

SHARED_END

#ifdef __cplusplus

#include "effects/composite/composite.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Owns the means.
struct AccumulateStore {
    gpu::HistoryImage direct{"accumulated_direct"};
    gpu::HistoryImage indirectDiffuse{"accumulated_indirect_diffuse"};
    gpu::HistoryImage indirectSpecular{"accumulated_indirect_specular"};
};

/// The means of the layers over this frame and the `framesBefore` before it. RGBA32F, as half floats would lose a
/// single frame's contribution to many.
LightLayers accumulate(gpu::PassList& f, AccumulateStore& own, const LightLayers& frame, uint32_t framesBefore);

}  // namespace reflet
#endif

#endif
