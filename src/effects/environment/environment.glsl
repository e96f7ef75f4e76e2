// Exact radiance of the environment along a direction. Bound by bindEnvironment (environment_light.h); uses the
// bindings from 100 on.
#ifndef REFLET_ENVIRONMENT_GLSL
#define REFLET_ENVIRONMENT_GLSL

#include "effects/environment/environment_light.h"
#include "effects/environment/equirectangular.glsl"

layout(constant_id = 100) const uint environmentIsOneColor = 0u;  // no image: one texel
layout(scalar) uniform EnvironmentUniforms { EnvironmentParams environment; };
uniform sampler2D environmentTexels;

// Rotates a world direction to the image's frame.
vec3 toEnvironment(vec3 direction) {
    vec2 turn = environment.turn;
    return vec3(direction.x * turn.x - direction.z * turn.y, direction.y, direction.z * turn.x + direction.x * turn.y);
}

// direction: world space, of any length but 0 [W/(m² sr)].
vec3 environmentRadiance(vec3 direction) {
    if (environmentIsOneColor != 0u) {
        return environment.factor * texelFetch(environmentTexels, ivec2(0), 0).rgb;
    }
    return environment.factor * equirectangularTexel(environmentTexels, toEnvironment(direction));
}

#endif
