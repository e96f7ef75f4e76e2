// Appends to a list of tiles. The includer declares the buffer `list` with these four members.
#ifndef REFLET_RAY_TILES_APPEND_GLSL
#define REFLET_RAY_TILES_APPEND_GLSL

#include "effects/lobe/ray_tiles.glsl"

// The indirect dispatch has one group per tile, in rows, because a single row is too short for all tiles.
void appendTile(uvec2 tile) {
    uint index = atomicAdd(list.count, 1u);
    list.items[index] = packTilePlace(tile);
    if (index % tileListRow == 0u) {
        atomicAdd(list.groups[1], 1u);
    }
}

#endif
