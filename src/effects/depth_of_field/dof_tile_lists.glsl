// Lists of tiles (depth_of_field.h): an image, as CPU devices read images faster than buffers. A list has as many rows as all tiles
// need that are in one.
#ifndef REFLET_DOF_TILE_LISTS_GLSL
#define REFLET_DOF_TILE_LISTS_GLSL

#include "effects/depth_of_field/depth_of_field.h"

const uint dofNoTile = 0xffffffffu;  // after the end of a list

// The first row of a list. rows: of the image
int listStart(uint list, int rows) { return int(list) * (rows / int(dofLists)); }

uint packTile(ivec2 tile) { return uint(tile.y << 16 | tile.x); }
ivec2 unpackTile(uint item) { return ivec2(item & 0xffffu, item >> 16u); }

#endif
