// Which disks reach a tile. In: radii in tiles. Out: near, and small near disks: the largest radius of the tiles whose disks may
// reach this one; background: the largest radius of this tile and those beside it. Of highlights: how many tiles have some
// that reach here, and which (row · 1024 + column).
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/depth_of_field.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint around = 1u;  // tiles that the largest disk reaches
layout(rgba16f) uniform readonly image2D tiles;
layout(rgba16f) uniform readonly image2D lists;
layout(rgba16f) uniform writeonly image2D reach;
layout(r32f) uniform writeonly image2D drawn;
layout(r32f) uniform writeonly image2D drawnTiles;

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = imageSize(tiles) - 1;
    if (any(greaterThan(tile, last))) {
        return;
    }
    vec3 largest = vec3(0.0);
    int count = 0;
    int side = 2 * int(around) + 1;
    int n = int(around);
    for (int y = -n; y <= n; ++y) {
        for (int x = -n; x <= n; ++x) {
            ivec2 other = clamp(tile + ivec2(x, y), ivec2(0), last);
            vec3 radii = imageLoad(tiles, other).rgb;
            vec2 apart = max(abs(vec2(x, y)) - 1.0, 0.0) * float(dofTile);
            largest.xz = max(largest.xz, mix(vec2(0.0), radii.xz, greaterThan(radii.xz, vec2(length(apart)))));
            largest.y = max(largest.y, max(abs(x), abs(y)) <= 1 ? radii.y : 0.0);
            if (imageLoad(lists, other).g > 2.0 * length(apart) && other == tile + ivec2(x, y)) {
                ivec2 place = tile * side + ivec2(count % side, count / side);
                imageStore(drawnTiles, place, vec4(other.y * 1024 + other.x));
                ++count;
            }
        }
    }
    imageStore(reach, tile, vec4(largest, 0.0));
    imageStore(drawn, tile, vec4(count));
}
