// Where levels lie that share one image, as levels.h says.
#ifndef REFLET_LEVELS_GLSL
#define REFLET_LEVELS_GLSL

ivec2 levelSize(ivec2 pixels, int level) { return (pixels + (1 << level) - 1) >> level; }

// The first row of a level, from 1 on: as levels.h has it.
int levelRow(ivec2 pixels, int level) { return pixels.y - (pixels.y >> (level - 1)) + level - 1; }

#endif
