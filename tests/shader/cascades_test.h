// Result of selectCascade. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_CASCADES_TEST_H
#define REFLET_TESTS_CASCADES_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct CascadeAnswer {
    uint index;
    float next;
};

SHARED_END

#endif
