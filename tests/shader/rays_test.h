// A ray and its slot, before and after packing. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_RAYS_TEST_H
#define REFLET_TESTS_RAYS_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct RayTexel {
    int slotX;
    int slotY;
    int slotZ;
    vec3 direction;
    float weight;
    float trust;
    float spread;
    uint highlighted;
};

// State of a waiting ray, without its slot.
struct WaitingItem {
    float rest;
    float clear;  // metres
    uint lost;
};

SHARED_END

#endif
