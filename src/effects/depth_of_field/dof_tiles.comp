// How far the layers of each tile reach. In: both layers. Out: the largest radius of the near layer, of the background, and of small
// disks of the near layer; the harmonic mean of brightness where there are highlights, else 0. And the largest radius of disks
// that are drawn at full resolution: of all, and of those that may reach the tile beside, above or below, and across the corner. And
// the list of tiles with highlights.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };
layout(rgba16f) uniform readonly image2D ground;
layout(rg16f) uniform readonly image2D groundBlur;
layout(rgba16f) uniform readonly image2D front;
layout(rg16f) uniform readonly image2D frontBlur;
layout(rgba16f) uniform writeonly image2D tiles;
layout(rgba16f) uniform writeonly image2D smallDisks;
layout(r32ui) uniform writeonly uimage2D tileLists;
layout(scalar) buffer ListHeadsBlock {
    DofListHead lists[dofLists];
} heads;

#include "effects/depth_of_field/dof_tile_append.glsl"

const int smallReach = 2;  // of disks at full resolution [cells]

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 first = tile * int(dofTile);
    ivec2 end = min(first + int(dofTile), ivec2(params.half2));
    if (any(greaterThanEqual(first, ivec2(params.half2)))) {
        return;
    }
    vec3 largest = vec3(0.0);
    vec2 dark = vec2(0.0);  // sum of 1 / brightness, count
    float brightest = 0.0;
    vec4 full = vec4(0.0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            // The radius of an empty near cell is 0.
            vec2 before = imageLoad(frontBlur, ivec2(x, y)).rg;
            float near = before.r;
            bool beside = min(x - first.x, end.x - 1 - x) < smallReach;
            bool above = min(y - first.y, end.y - 1 - y) < smallReach;
            full = max(full, before.g * vec4(1.0, beside, above, beside && above));
            vec2 far = imageLoad(groundBlur, ivec2(x, y)).rg;
            float small = near < large.y ? near : 0.0;
            vec4 behind = imageLoad(ground, ivec2(x, y));
            float bright = brightness(behind.rgb * behind.a + imageLoad(front, ivec2(x, y)).rgb);
            dark += vec2(1.0 / bright, 1.0);
            brightest = max(brightest, bright);
            largest = max(largest, vec3(near, far.g > 0.0 ? far.r : 0.0, small));
        }
    }
    float darkness = dark.y / dark.x;
    bool some = brightest > highlight.x * darkness && 2.0 * max(largest.x, largest.y) > leastHighlight(params.block);
    imageStore(tiles, tile, vec4(largest, some ? darkness : 0.0));
    imageStore(smallDisks, tile, full);
    if (some) {
        append(dofBright, tile, 1u);
    }
}
