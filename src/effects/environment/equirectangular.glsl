// Equirectangular images: scene/environment.h, for rotation 0.
#ifndef REFLET_EQUIRECTANGULAR_GLSL
#define REFLET_EQUIRECTANGULAR_GLSL

#include "shaders/sampling.glsl"

vec2 equirectangularUv(vec3 direction) {
    float across = length(direction.xz);
    float u = 0.5 + (across > 0.0 ? atan(direction.x, -direction.z) : 0.0) / (2.0 * pi);
    return vec2(u - floor(u), atan(across, direction.y) / pi);
}

// Nearest filtering.
vec3 equirectangularTexel(sampler2D texels, vec3 direction) {
    ivec2 size = textureSize(texels, 0);
    return texelFetch(texels, min(ivec2(equirectangularUv(direction) * vec2(size)), size - 1), 0).rgb;
}

#endif
