// Reflection probes as a ray source: an approximation of what the ray would hit. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_ANSWER_PROBES_H
#define REFLET_EFFECTS_ANSWER_PROBES_H

#include "base/shared.h"
#include "effects/probe/probes.h"
#include "effects/view.h"

SHARED_BEGIN

struct AnswerProbesParams {
    ViewParams view;
    ProbeBlock probes;
    uint firstRay;
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Gives rays that start in a probe's box its radiance, as far as the probe does not see the sky. The others stay in
/// rays.waiting.
void answerProbes(gpu::PassList& f, Rays& rays, const ProbeMaps& probes);

}  // namespace reflet
#endif

#endif
