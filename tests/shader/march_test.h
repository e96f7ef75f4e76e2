// Rays through made-up depth. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_MARCH_TEST_H
#define REFLET_TESTS_MARCH_TEST_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

const uint marchMaxWalls = 2;

// What the camera sees: parts of planes, sky elsewhere.
struct MarchWall {
    vec4 plane;    // dot(plane, (p, 1)) = 0 in world space
    vec2 firstUv;  // only pixels whose centres lie here
    vec2 lastUv;
};

struct MarchScene {
    ViewParams view;
    MarchWall walls[marchMaxWalls];
    uint wallCount;
};

struct MarchRay {
    vec3 origin;
    vec3 direction;
    float stepLength;
    uint maxSteps;
    float thickness;
    float jitter;
    vec3 normal;  // of the plane that the ray leaves; 0: none
};

struct MarchAnswer {
    uint outcome;
    int pixelX;
    int pixelY;
    float distance;
    uint steps;
};

SHARED_END

#endif
