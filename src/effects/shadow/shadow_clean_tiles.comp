// Lists the screen tiles that contain a penumbra and are neither fully lit nor fully shadowed, and copies the
// visibility, which the other tiles keep. One thread per tile. In: visibility, penumbra. Out: tiles, visibility.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/shadow/shadow_clean.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ShadowTilesParams params; };
layout(r8) uniform readonly image2D visibility;
layout(rg16f) uniform readonly image2D penumbra;
layout(r8) uniform writeonly image2D cleaned;
layout(scalar) buffer TilesBlock {
    uint groups[3];
    uint count;
    uint items[];
} tiles;

void main() {
    ivec2 first = ivec2(gl_GlobalInvocationID.xy) * int(shadowTileSide);
    ivec2 end = min(first + int(shadowTileSide), ivec2(params.size));
    float lowest = 1.0;
    float highest = 0.0;
    float widest = 0.0;
    for (int y = first.y; y < end.y; ++y) {
        for (int i = 0; i < int(shadowTileSide); ++i) {  // a known number: the loads of a row are under way at once
            ivec2 pixel = ivec2(min(first.x + i, end.x - 1), y);
            float v = imageLoad(visibility, pixel).r;
            lowest = min(lowest, v);
            highest = max(highest, v);
            widest = max(widest, imageLoad(penumbra, pixel).r);
            imageStore(cleaned, pixel, vec4(v));
        }
    }
    if (lowest < 1.0 && highest > 0.0 && widest > 0.0) {
        uint index = atomicAdd(tiles.count, 1u);
        tiles.items[index] = gl_GlobalInvocationID.x | gl_GlobalInvocationID.y << 16u;
        if (index < maxShadowTileGroups) {
            atomicAdd(tiles.groups[0], 1u);
        }
    }
}
