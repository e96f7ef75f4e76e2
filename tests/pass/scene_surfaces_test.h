// The surface that a ray through each pixel's centre finds. Shared by C++ and GLSL.
#ifndef REFLET_TESTS_SCENE_SURFACES_TEST_H
#define REFLET_TESTS_SCENE_SURFACES_TEST_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

struct SurfaceOfPixel {
    vec3 baseColor;
    float roughness;
    vec3 normal;
    float metallic;
    vec3 emissive;
    float occlusion;
    float distance;  // metres in front of the camera; 0: nothing
};

struct SceneSurfacesTestParams {
    ViewParams view;
    float widthPerPixel;  // footprint; 0: none
};

SHARED_END

#endif
