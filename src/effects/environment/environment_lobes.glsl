// Prefiltered radiance and irradiance of the environment. Bound by bindEnvironmentLobes (environment_light.h).
#ifndef REFLET_ENVIRONMENT_LOBES_GLSL
#define REFLET_ENVIRONMENT_LOBES_GLSL

#include "effects/cube_map/cube_map.glsl"
#include "effects/environment/environment.glsl"

uniform samplerCubeArray environmentLobes;
uniform sampler2D environmentIrradiance;

// Mean radiance weighted by the GGX lobe of this perceptual roughness around the direction.
vec3 environmentLobe(vec3 direction, float roughness) {
    return environment.factor * cubeMapLobe(environmentLobes, 0u, toEnvironment(direction), roughness);
}

// Irradiance / pi for the unit normal n: the mean radiance of cosine-distributed rays.
vec3 environmentIrradianceOverPi(vec3 n) {
    return environment.factor * cubeMapIrradiance(environmentIrradiance, 0u, toEnvironment(n));
}

#endif
