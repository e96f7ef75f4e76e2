// The last source of the chain: what lies behind everything. It answers every ray. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_ANSWER_ENVIRONMENT_H
#define REFLET_RENDER_ANSWER_ENVIRONMENT_H

#include "base/shared.h"

SHARED_BEGIN

// Hit distance of what has none [m]: far, and a half float.
const float environmentDistance = 10000.0;

#define ENVIRONMENT_SETTINGS(VALUE, SWITCH, CHOICE)                                                                 \
    SWITCH(enabled, 1,                                                                                              \
           "Image-based lighting: rays that hit nothing get the environment. Off: they are black; the background "  \
           "stays visible.")                                                                                        \
    VALUE(float, occludedWeight, 0.5, 0.0, 1.0,                                                                     \
          "Share of environment light for rays that passed behind a visible surface, where the screen cannot tell " \
          "whether they hit. 0: darker; 1: more light leaking.")
SETTINGS(EnvironmentSettings, ENVIRONMENT_SETTINGS)

struct AnswerEnvironmentParams {
    EnvironmentSettings settings;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/bounce/rays.h"
#include "render/environment/environment_light.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// Answers all that waits: single rays with the exact radiance, those that stand for a lobe or for the hemisphere
/// (Ray.spread) with the filtered one. Diffuse rays from surfaces with an occlusion map get less of it: the map knows
/// of nearby surfaces that the rays could not meet.
void answerEnvironment(gpu::Frame& f, Rays& rays, const EnvironmentLight& environment,
                       const EnvironmentSettings& settings);

}  // namespace reflet
#endif

#endif
