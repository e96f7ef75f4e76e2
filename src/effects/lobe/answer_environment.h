// The last ray source of the chain, image-based lighting: gives every remaining ray the environment's radiance. Shared
// by C++ and GLSL.
#ifndef REFLET_EFFECTS_ANSWER_ENVIRONMENT_H
#define REFLET_EFFECTS_ANSWER_ENVIRONMENT_H

#include "base/shared.h"

SHARED_BEGIN

// Hit distance stored for misses [m]: far away, but representable as a half float.
const float environmentDistance = 10000.0;

#define ENVIRONMENT_SETTINGS(VALUE, SWITCH, CHOICE)                                                                \
    SWITCH(enabled, 1,                                                                                             \
           "Image-based lighting: rays that hit nothing get the environment. Off: they are black; the background " \
           "stays visible.")                                                                                       \
    VALUE(                                                                                                         \
        float, occludedWeight, 0.5, 0.0, 1.0,                                                                      \
        "Share of environment light for rays that passed behind a visible surface, where the screen cannot tell "  \
        "whether they hit. The rest is the light of that surface, if it is darker. 0: darker; 1: more light leaking.")
SETTINGS(EnvironmentSettings, ENVIRONMENT_SETTINGS)

struct AnswerEnvironmentParams {
    EnvironmentSettings settings;
};

SHARED_END

#ifdef __cplusplus

#include "effects/environment/environment_light.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Single rays get the exact radiance, cones and hemispheres (Ray.spread) the prefiltered one. Diffuse rays from
/// surfaces with an occlusion map get less, because the map stands for nearby geometry that the rays could not hit.
void answerEnvironment(gpu::PassList& f, Rays& rays, const EnvironmentLight& environment,
                       const EnvironmentSettings& settings);

}  // namespace reflet
#endif

#endif
