// Which disks reach a tile. In: radii in tiles. Out: near, and small near disks: the largest radius of the tiles whose disks may
// reach this one; background, and disks at full resolution: the largest radius of this tile and those beside it. Of highlights: how many tiles have some
// that reach here, and which (row · 1024 + column). And the lists of tiles.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint around = 1u;  // tiles that the largest disk reaches
layout(rgba16f) uniform readonly image2D tiles;
layout(rgba16f) uniform readonly image2D lists;
layout(rgba16f) uniform readonly image2D smallDisks;
layout(rgba16f) uniform writeonly image2D reach;
layout(r32f) uniform writeonly image2D drawn;
layout(r32f) uniform writeonly image2D drawnTiles;
layout(r32ui) uniform writeonly uimage2D tileLists;
layout(scalar) buffer ListHeadsBlock {
    DofListHead lists[dofLists];
} heads;

#include "effects/depth_of_field/dof_tile_append.glsl"

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = imageSize(tiles) - 1;
    if (any(greaterThan(tile, last))) {
        return;
    }
    vec3 largest = vec3(0.0);
    float small = 0.0;
    float largestFar = 0.0;  // of all tiles around: holes are filled from there
    int count = 0;
    int side = 2 * int(around) + 1;
    int n = int(around);
    for (int y = -n; y <= n; ++y) {
        for (int x = -n; x <= n; ++x) {
            ivec2 other = clamp(tile + ivec2(x, y), ivec2(0), last);
            vec3 radii = imageLoad(tiles, other).rgb;
            vec2 apart = max(abs(vec2(x, y)) - 1.0, 0.0) * float(dofTile);
            largest.xz = max(largest.xz, mix(vec2(0.0), radii.xz, greaterThan(radii.xz, vec2(length(apart)))));
            bool beside = max(abs(x), abs(y)) <= 1;
            largest.y = max(largest.y, beside ? radii.y : 0.0);
            vec4 disks = imageLoad(smallDisks, other);
            float reaching = y == 0 ? x == 0 ? disks.r : disks.g : x == 0 ? disks.b : disks.a;
            small = max(small, beside ? reaching : 0.0);
            largestFar = max(largestFar, radii.y);
            if (imageLoad(lists, other).g > 2.0 * length(apart) && other == tile + ivec2(x, y)) {
                ivec2 place = tile * side + ivec2(count % side, count / side);
                imageStore(drawnTiles, place, vec4(other.y * 1024 + other.x));
                ++count;
            }
        }
    }
    imageStore(reach, tile, vec4(largest, small));
    imageStore(drawn, tile, vec4(count));
    bool hasFront = largest.x > 0.0;
    bool blurred = hasFront || largest.y > 0.0;
    uint front = hasFront ? dofFront : 0u;
    if (blurred) {
        append(dofGather + front, tile, 1u);
    }
    if (blurred && max(largest.x, hasFront ? largestFar : largest.y) > large.x) {
        append(dofGatherLarge + front, tile, dofGroupTiles);
    }
    uint kind = (count > 0 ? dofHighlights : 0u) + (small > 0.0 ? dofSmall : 0u);
    append(blurred || kind != 0u ? dofComposite + kind : dofCopy, tile, 1u);
}
