// Reads the hierarchical depth buffer. The includer declares the image pyramid.
#ifndef REFLET_PYRAMID_GLSL
#define REFLET_PYRAMID_GLSL

#include "effects/levels.glsl"
#include "effects/pyramid/pyramid.h"

// As loadCell in shaders/march_hiz.glsl. pixels: size of the depth buffer.
vec2 pyramidCell(ivec2 cell, int level, vec2 pixels) {
    return imageLoad(pyramid, levelPlace(cell, level, ivec2(pixels))).rg;
}

#endif
