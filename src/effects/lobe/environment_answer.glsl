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
// unoccluded. Of the rays that passed behind a visible surface some hit what the screen does not show. It is taken to be as
// bright as the surface in front, but no brighter than the environment, which may be its only light: black would make white
// things darker than what surrounds them.
RayAnswer answerOfEnvironment(Ray ray, float occlusion, bool lost, vec3 inFront) {
    vec3 open = radianceFor(ray);
    float share = lost ? environmentAnswer.settings.occludedWeight : 1.0;
    return RayAnswer(mix(min(inFront, open), open, share) * occlusion, 1.0, environmentDistance);
}

#endif
