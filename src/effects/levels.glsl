// Layout of a mip chain in one image, see levels.h.
#ifndef REFLET_LEVELS_GLSL
#define REFLET_LEVELS_GLSL

ivec2 levelSize(ivec2 pixels, int level) { return (pixels + (1 << level) - 1) >> level; }

// The first row of a level, from 1 on; see levels.h.
int levelRow(ivec2 pixels, int level) { return pixels.y - (pixels.y >> (level - 1)) + level - 1; }

#endif
