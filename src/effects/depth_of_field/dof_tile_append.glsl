// Appends to a list of tiles. The includer declares the image `tileLists` and the buffer `heads` with these members.
#ifndef REFLET_DOF_TILE_APPEND_GLSL
#define REFLET_DOF_TILE_APPEND_GLSL

#include "effects/depth_of_field/dof_tile_lists.glsl"

// perGroup: tiles per group of the dispatch.
void append(uint list, ivec2 tile, uint perGroup) {
    uint row = dofListRow * perGroup;
    uint index = atomicAdd(heads.lists[list].count, 1u);
    imageStore(tileLists, ivec2(index % row, listStart(list, imageSize(tileLists).y) + int(index / row)), uvec4(packTile(tile)));
    if (index % row == 0u) {
        atomicAdd(heads.lists[list].groups[1], 1u);
    }
}

#endif
