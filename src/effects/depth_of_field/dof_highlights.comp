// Finds highlights: light that is far brighter than what is around it, whose disks have edges that half resolution would show. In:
// radiance, circle of confusion, darkness of the tiles. Out, in the tiles of a list: a disk for each block that has a highlight; the layers
// without the light of these.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/depth_of_field.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };
layout(rgba16f) uniform readonly image2D tiles;
layout(rgba16f) uniform writeonly image2D highlights;      // radiance of the disk, signed radius
layout(rgba16f) uniform writeonly image2D highlightShape;  // centre from the tile's corner, radius, 1 over the width of the edge
layout(r32ui) uniform readonly uimage2D tileLists;

#include "effects/depth_of_field/dof_picture.glsl"
#include "effects/depth_of_field/dof_tile_lists.glsl"

// A group finds the highlights of a tile: a thread for each cell of 2 x 2 pixels, those of a block beside one another.
const int threads = int(dofTile * dofTile);
const int pixels = 2 * int(dofTile);
const int seen = pixels + 2;  // with those around the tile

shared vec2 bright[seen * seen];  // brightness of pixels with highlights, signed radius
shared vec2 brightest[threads];   // of a cell's pixels and those around it; of the first thread of a block: of the block's
shared vec4 light[threads];       // share · radiance, of its brightness
shared vec3 moments[threads];     // of brightness: x, y, squared length

int cells = int(params.block) / 2;  // of a block, to a side
int group = cells * cells;

void lookAround(ivec2 tile, int index, float darkness) {
    for (int i = index; i < seen * seen; i += threads) {
        ivec2 pixel = clamp(pixels * tile + ivec2(i % seen, i / seen) - 1, ivec2(0), ivec2(params.size) - 1);
        vec3 c = lightAt(pixel);
        float radius = cocAt(pixel);
        bright[i] = vec2(highlightShare(c, radius, darkness, params.block) > 0.0 ? brightness(c) : 0.0, radius);
    }
}

// A pixel at the edge of a lamp has the depth of what is behind, but the lamp's light.
vec2 brightestAround(ivec2 inTile) {
    vec2 most = vec2(0.0);
    for (int i = 0; i < 16; ++i) {
        vec2 there = bright[(2 * inTile.y + (i >> 2)) * seen + 2 * inTile.x + (i & 3)];
        most = there.x > most.x ? there : most;
    }
    return most;
}

// corner: of the cell's block [pixels].
void sumCell(int index, ivec2 cell, ivec2 corner, float darkness) {
    ivec2 last = ivec2(params.size) - 1;
    light[index] = vec4(0.0);
    moments[index] = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 pixel = 2 * cell + ivec2(i & 1, i >> 1);
        vec3 c = lightAt(min(pixel, last));
        float share = highlightShare(c, cocAt(min(pixel, last)), darkness, params.block);
        share = any(greaterThan(pixel, last)) ? 0.0 : share;
        vec2 at = vec2(pixel - corner) + 0.5;
        light[index] += share * vec4(c, brightness(c));
        moments[index] += share * brightness(c) * vec3(at, dot(at, at));
    }
}

// Sums of a block's threads, in its first one.
void sumBlock(int index) {
    for (int apart = threads / 2; apart > 0; apart >>= 1) {
        barrier();
        if (apart < group && (index & (group - 1)) < apart) {
            vec2 other = brightest[index + apart];
            brightest[index] = other.x > brightest[index].x ? other : brightest[index];
            light[index] += light[index + apart];
            moments[index] += moments[index + apart];
        }
    }
    barrier();
}

void storeDisk(ivec2 block, vec2 corner, int first) {
    float c = brightest[first].y;
    vec3 mean = moments[first] / max(light[first].a, 1e-9);
    float spread = max(mean.z - dot(mean.xy, mean.xy), 0.0);
    float edge2 = max(6.0 * spread - 1.0, 1.0);  // of a disk of the light's own size; antialiasing has spread it
    float radius2 = max(c * c - edge2 / 12.0, 0.25);
    vec3 radiance = min(light[first].rgb * params.disk / (radius2 + edge2 / 12.0), 65504.0);
    imageStore(highlights, block, vec4(radiance, c));
    imageStore(highlightShape, block, vec4(corner + mean.xy, sqrt(radius2), inversesqrt(edge2)));
}

void main() {
    ivec2 place = ivec2(gl_WorkGroupID.xy);
    uint item = imageLoad(tileLists, place + ivec2(0, listStart(dofBright, imageSize(tileLists).y))).r;
    if (item == dofNoTile) {
        return;
    }
    ivec2 tile = unpackTile(item);
    int index = int(gl_LocalInvocationIndex);
    int inBlock = index & (group - 1);
    int number = index / group;
    int side = tileBlocks(params.block);
    ivec2 blockInTile = ivec2(number & (side - 1), number / side);
    ivec2 inTile = cells * blockInTile + ivec2(inBlock & (cells - 1), inBlock / cells);
    ivec2 cell = int(dofTile) * tile + inTile;
    float darkness = imageLoad(tiles, tile).a;
    lookAround(tile, index, darkness);
    barrier();
    brightest[index] = brightestAround(inTile);
    sumCell(index, cell, pixels * tile + 2 * cells * blockInTile, darkness);
    sumBlock(index);
    // Cells, and the list, change where there is a highlight.
    if (light[index - inBlock].a > 0.0 && all(lessThan(cell, ivec2(params.half2)))) {
        splitCell(cell, darkness);
    }
    if (inBlock == 0 && all(lessThan(2 * cell, ivec2(params.size)))) {
        storeDisk(side * tile + blockInTile, vec2(2 * cells * blockInTile), index);
    }
}
