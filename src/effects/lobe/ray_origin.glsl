// Where a pixel's rays start. Bound by the sources of rays, from RaySurfaces.
#ifndef REFLET_RAY_ORIGIN_GLSL
#define REFLET_RAY_ORIGIN_GLSL

#include "effects/view.h"
#include "shaders/projection.glsl"

layout(constant_id = 42) const uint startsElsewhere = 0u;  // 1: not at the pixel's surface
uniform sampler2D origins;

// depth: of the pixel's surface.
vec3 rayOrigin(ivec2 pixel, float depth, ViewParams view) {
    if (startsElsewhere != 0u) {
        return texelFetch(origins, pixel, 0).xyz;
    }
    return uvToWorld(pixelToUv(pixel, view.pixel), depth, view.clipToWorld);
}

#endif
