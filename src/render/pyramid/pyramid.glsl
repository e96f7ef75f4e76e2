// Where the pyramid's levels lie in its image.
#ifndef REFLET_PYRAMID_GLSL
#define REFLET_PYRAMID_GLSL

#include "render/pyramid/pyramid.h"

ivec2 pyramidSize(ivec2 pixels, int level) { return (pixels + (1 << level) - 1) >> level; }

// The first row of a level, from 1 on.
int pyramidRow(ivec2 pixels, int level) {
    int row = 0;
    for (int l = 1; l < level; ++l) {
        row += pyramidSize(pixels, l).y;
    }
    return row;
}

#endif
