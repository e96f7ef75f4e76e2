// Rays through synthetic depth. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_MARCH_TEST_H
#define REFLET_TESTS_MARCH_TEST_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

const uint marchMaxWalls = 2;

// What the camera sees: parts of planes, sky elsewhere.
struct MarchWall {
    vec4 plane;    // dot(plane, (p, 1)) = 0 in world space
    vec2 firstUv;  // only pixels whose centres lie here
    vec2 lastUv;
    vec4 backPlane;  // where the back face is; 0: there is none
};

struct MarchScene {
    ViewParams view;
    MarchWall walls[marchMaxWalls];
    uint wallCount;
};

const uint marchMethodLinear = 0;
const uint marchMethodHalving = 1;
const uint marchMethodFixedPoint = 2;
const uint marchMethodDda = 3;
const uint marchMethodExhaustive = 4;
const uint marchMethodHiz = 5;
const int marchLevels = 6;

// How long rays get in the methods that step through pixels.
const float marchLongest = 1000;

struct MarchInput {
    vec3 origin;
    vec3 direction;
    float stepLength;  // metres; DDA: pixels; fixed point: the first distance
    uint maxSteps;
    float thickness;
    float jitter;
    vec3 normal;     // of the plane that the ray leaves; 0: none
    float smallest;  // halving: step; fixed point: tolerance
    uint binarySteps;
    uint interpolate;
    uint thickAsStep;
};

struct MarchAnswer {
    uint outcome;
    int pixelX;
    int pixelY;
    float distance;
    float clear;
    uint lost;
    uint steps;
};

SHARED_END

#endif
