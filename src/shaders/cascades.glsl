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
    while (i + 1u < sun.count && distance >= sun.ends[i]) {
        ++i;
    }
    float next = 0.0;
    if (i + 1u < sun.count && distance > sun.blends[i]) {
        next = (distance - sun.blends[i]) / (sun.ends[i] - sun.blends[i]);
    }
    return Cascade(i, next);
}

// First texel of a cascade's tile in the shadow image.
ivec2 cascadeTileOrigin(uint index, uint resolution) { return ivec2(index % 2u, index / 2u) * int(resolution); }

#endif
