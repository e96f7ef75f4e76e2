// Rays from random pixels of a real scene, traced by three methods. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_ORACLE_TEST_H
#define REFLET_TESTS_ORACLE_TEST_H

#include "base/shared.h"
#include "effects/lobe/trace_screen.h"

SHARED_BEGIN

struct OracleParams {
    ViewParams view;
    TraceScreenSettings settings;
};

struct OracleAnswer {
    uint hit;
    int x;  // pixel of the hit, else the last one visited
    int y;
    uint lost;    // 1: it went behind something
    float clear;  // metres until then
    uint steps;
};

struct OracleRay {
    uint found;  // 0: no pixel with a surface was found to start from
    int x;       // where it starts
    int y;
    OracleAnswer exhaustive;
    OracleAnswer hiz;
    OracleAnswer dda;
};

SHARED_END

#endif
