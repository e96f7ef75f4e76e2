// Appends to a list of tiles. The includer declares the buffer `list` with these four members.
#ifndef REFLET_RAY_TILES_APPEND_GLSL
#define REFLET_RAY_TILES_APPEND_GLSL

#include "render/bounce/ray_tiles.glsl"

// Each tile has a group of threads of the indirect dispatch, in rows: one row holds fewer than there may be tiles.
void appendTile(uvec2 tile) {
    uint index = atomicAdd(list.count, 1u);
    list.items[index] = packTilePlace(tile);
    if (index % tileListRow == 0u) {
        atomicAdd(list.groups[1], 1u);
    }
}

#endif
