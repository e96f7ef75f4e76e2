// A shading normal to be bent. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_SHADING_NORMAL_TEST_H
#define REFLET_TESTS_SHADING_NORMAL_TEST_H

#include "base/shared.h"

SHARED_BEGIN

struct NormalCase {
    vec3 normal;
    vec3 geometric;
    vec3 toViewer;
};

SHARED_END

#endif
