// Parameters of sampling_test.comp. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_SAMPLING_TEST_H
#define REFLET_TESTS_SAMPLING_TEST_H

#include "base/shared.h"

SHARED_BEGIN

const uint samplerCosineHemisphere = 0;
const uint samplerUniformHemisphere = 1;
const uint samplerGgx = 2;
const uint samplerGgxVisible = 3;

struct SamplingParams {
    float alpha;
    vec3 v;  // toward the eye, around +Z (samplerGgxVisible)
};

SHARED_END

#endif
