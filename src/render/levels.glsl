// Where levels lie that share one image, as levels.h says.
#ifndef REFLET_LEVELS_GLSL
#define REFLET_LEVELS_GLSL

ivec2 levelSize(ivec2 pixels, int level) { return (pixels + (1 << level) - 1) >> level; }

// The first row of a level, from 1 on.
int levelRow(ivec2 pixels, int level) {
    int row = 0;
    for (int l = 1; l < level; ++l) {
        row += levelSize(pixels, l).y;
    }
    return row;
}

#endif
