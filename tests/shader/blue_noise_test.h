// Inputs and outputs of blue_noise_test.comp. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_BLUE_NOISE_TEST_H
#define REFLET_TESTS_BLUE_NOISE_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct BlueNoiseCase {
    uvec2 pixel;
    uint stream;
    uint frame;
    uint number;
    uint count;
};

struct BlueNoiseSample {
    uint texel;
    uvec2 sobol;  // point `number` of the sequence
    vec2 point;
};

SHARED_END

#endif
