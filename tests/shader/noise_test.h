// Outputs of noise_test.comp for a pixel. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_NOISE_TEST_H
#define REFLET_TESTS_NOISE_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct NoiseSample {
    uint hash;
    float unit;
    vec2 pair;
};

SHARED_END

#endif
