// Selects the shadow cascade for a pixel.
#ifndef REFLET_CASCADES_GLSL
#define REFLET_CASCADES_GLSL

#include "effects/shadow/shadow.h"

struct Cascade {
    uint index;
    float next;  // weight of the next cascade: above 0 in the blend range
};

// distance: metres in front of the camera. Points beyond the end of the last cascade use the last one.
Cascade selectCascade(float distance, SunShadowParams sun) {
    uint i = 0u;
    float end = sun.ends[0];
    float blend = sun.blends[0];
    for (uint k = 1u; k < maxCascades; ++k) {  // constant indices: by others compilers would copy the arrays to memory
        if (i + 1u == k && k < sun.count && distance >= end) {
            i = k;
            end = sun.ends[k];
            blend = sun.blends[k];
        }
    }
    float next = 0.0;
    if (i + 1u < sun.count && distance > blend) {
        next = (distance - blend) / (end - blend);
    }
    return Cascade(i, next);
}

// First texel of a cascade's tile in the shadow image.
ivec2 cascadeTileOrigin(uint index, uint resolution) { return ivec2(index % 2u, index / 2u) * int(resolution); }

#endif
