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
};

SHARED_END

#endif
