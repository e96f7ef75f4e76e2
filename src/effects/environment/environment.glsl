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
    vec3 axis = environment.turn.xyz;
    return direction + 2.0 * cross(axis, cross(axis, direction) + environment.turn.w * direction);
}

// direction: world space, of any length but 0 [W/(m² sr)].
vec3 environmentRadiance(vec3 direction) {
    if (environmentIsOneColor != 0u) {
        return environment.factor * texelFetch(environmentTexels, ivec2(0), 0).rgb;
    }
    return environment.factor * equirectangularTexel(environmentTexels, toEnvironment(direction));
}

// The mean over a small parallelogram of directions: its centre and its sides, by 4x4 samples.
vec3 environmentMean(vec3 middle, vec3 across, vec3 down) {
    if (environmentIsOneColor != 0u) {
        return environmentRadiance(middle);
    }
    vec2 uv = equirectangularUv(toEnvironment(middle));
    vec2 x = equirectangularUv(toEnvironment(middle + across)) - uv;
    vec2 y = equirectangularUv(toEnvironment(middle + down)) - uv;
    x.x -= round(x.x);
    y.x -= round(y.x);
    ivec2 size = textureSize(environmentTexels, 0);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 16; ++i) {
        vec2 at = (vec2(i & 3, i >> 2) - 1.5) / 4.0;
        vec2 sampled = uv + at.x * x + at.y * y;
        sampled = vec2(sampled.x - floor(sampled.x), clamp(sampled.y, 0.0, 1.0));
        sum += texelFetch(environmentTexels, min(ivec2(sampled * vec2(size)), size - 1), 0).rgb;
    }
    return environment.factor * sum / 16.0;
}

#endif
