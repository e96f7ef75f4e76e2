// Layout of a mip chain in one image, see levels.h.
#ifndef REFLET_LEVELS_GLSL
#define REFLET_LEVELS_GLSL

ivec2 levelSize(ivec2 pixels, int level) { return (pixels + (1 << level) - 1) >> level; }

// The first row of a level, from 1 on; see levels.h.
int levelRow(ivec2 pixels, int level) { return pixels.y - (pixels.y >> (level - 1)) + level - 1; }

// Where a cell is in an image that also holds level 0, at the left of the others. pixels: size of level 0.
ivec2 levelPlace(ivec2 cell, int level, ivec2 pixels) {
    return cell + ivec2(level > 0 ? pixels.x : 0, levelRow(pixels, max(level, 1)));
}

#endif
