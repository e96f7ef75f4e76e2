// The environment's answer to a ray. Bound by bindEnvironment and bindEnvironmentLobes. The includer declares
// environmentAnswer (AnswerEnvironmentParams) and the constants lobe, environmentLights (the settings' switch) and
// spreads: whether any Ray.spread is above 0.
#ifndef REFLET_ENVIRONMENT_ANSWER_GLSL
#define REFLET_ENVIRONMENT_ANSWER_GLSL

#include "effects/environment/environment_lobes.glsl"
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/rays.glsl"

vec3 radianceFor(Ray ray) {
    if (environmentLights == 0u) {
        return vec3(0.0);
    }
    if (spreads == 0u || ray.spread == 0.0) {
        return environmentRadiance(ray.direction);
    }
    return lobe == lobeDiffuse ? environmentIrradianceOverPi(ray.direction) : environmentLobe(ray.direction, ray.spread);
}

// occlusion: of the surface's occlusion map, which stands for nearby geometry; 1 for rays that ray tracing has found to be
// unoccluded. lost: the ray passed behind a visible surface.
RayAnswer answerOfEnvironment(Ray ray, float occlusion, bool lost) {
    float share = occlusion * (lost ? environmentAnswer.settings.occludedWeight : 1.0);
    return RayAnswer(radianceFor(ray) * share, 1.0, environmentDistance);
}

#endif
