// A source of the chain: local probes. They stand in for what the ray would meet. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_ANSWER_PROBES_H
#define REFLET_RENDER_ANSWER_PROBES_H

#include "base/shared.h"
#include "render/probe/probes.h"
#include "render/view.h"

SHARED_BEGIN

struct AnswerProbesParams {
    ViewParams view;
    ProbesSettings settings;
    ProbeBlock probes;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/bounce/rays.h"

namespace reflet {

/// Answers rays from points in a probe's box, as far as the probes there do not see the sky. Hands on the others.
void answerProbes(gpu::Frame& f, Rays& rays, const ProbeMaps& probes, const ProbesSettings& settings);

}  // namespace reflet
#endif

#endif
