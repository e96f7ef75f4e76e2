// Look-ups of blurred light. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_LIGHT_MIPS_TEST_H
#define REFLET_TESTS_LIGHT_MIPS_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct LightLookup {
    vec2 at;
    float width;
};

SHARED_END

#endif
