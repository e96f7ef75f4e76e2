// Where a pixel's rays start. Bound by bindRayOrigins (rays.h).
#ifndef REFLET_RAY_ORIGIN_GLSL
#define REFLET_RAY_ORIGIN_GLSL

#include "effects/view.h"
#include "shaders/projection.glsl"

layout(constant_id = 42) const uint startsElsewhere = 0u;  // 1: not at the pixel's surface
uniform sampler2DArray origins;

// slot: pixel and number of the ray; depth: of the pixel's surface.
vec3 rayOrigin(ivec3 slot, float depth, ViewParams view) {
    if (startsElsewhere != 0u) {
        return texelFetch(origins, slot, 0).xyz;
    }
    return uvToWorld(pixelToUv(slot.xy, view.pixel), depth, view.clipToWorld);
}

#endif
