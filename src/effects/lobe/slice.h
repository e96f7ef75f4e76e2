// Slices: planes through the eye and a point, on each of which screen-space surfaces cover a range of directions. The
// unoccluded directions, and the light of the occluders, are found in a fixed number of look-ups (Jimenez et al.,
// Practical Real-Time Strategies for Accurate Indirect Occlusion, 2016; Therrien, Levesque and Gilet, Screen Space
// Indirect Lighting with Visibility Bitmask, 2023). Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_SLICE_H
#define REFLET_EFFECTS_SLICE_H

#include "base/shared.h"

SHARED_BEGIN

// How thick surfaces are taken to be, as the specialization constant `sliceThickness`.
const uint sliceThicknessConstant = 0;
const uint sliceThicknessGrowing = 1;  // in proportion to the distance from the point
const uint sliceThicknessLayer = 2;    // up to the back face

struct SliceParams {
    uint steps;       // look-ups to each side of the point
    float radius;     // metres; surfaces farther away cover nothing
    float falloff;    // share of the radius over which the cover fades
    float thickness;  // metres along the view; growing: per metre from the point
};

SHARED_END

#endif
