// Which of the sun's shadow maps a pixel looks into.
#ifndef REFLET_CASCADES_GLSL
#define REFLET_CASCADES_GLSL

#include "render/shadow/shadow.h"

struct Cascade {
    uint index;
    float next;  // share of the cascade after this one: above 0 where they blend
};

// distance: metres in front of the camera. What lies beyond the last cascade's end is in the last one.
Cascade cascadeAt(float distance, SunShadowParams sun) {
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

// The texel of the shadow image where a cascade's tile begins.
ivec2 cascadeTile(uint index, uint resolution) { return ivec2(index % 2u, index / 2u) * int(resolution); }

#endif
