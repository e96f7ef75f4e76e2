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

int side = int(params.block);
int around = side + 2;
int cells = side / 2;
int tileSide = tileBlocks(params.block);

void main() {
    ivec2 place = ivec2(gl_WorkGroupID.x * dofGroupTiles + (gl_LocalInvocationIndex >> 4u), gl_WorkGroupID.y);
    uint item = imageLoad(tileLists, place + ivec2(0, listStart(dofBright, imageSize(tileLists).y))).r;
    ivec2 tile = unpackTile(item);
    int index = int(gl_LocalInvocationIndex & 15u);
    ivec2 inTile = ivec2(index & 3, index >> 2);
    ivec2 block = tile * tileSide + inTile;
    ivec2 blocks = (ivec2(params.size) + side - 1) / side;
    if (item == dofNoTile || any(greaterThanEqual(inTile, ivec2(tileSide))) || any(greaterThanEqual(block, blocks))) {
        return;
    }
    float darkness = imageLoad(tiles, tile).a;
    ivec2 last = ivec2(params.size) - 1;
    // A pixel at the edge of a lamp has the depth of what is behind, but the lamp's light.
    float brightest = 0.0;
    float c = 0.0;
    for (int i = 0; i < around * around; ++i) {
        ivec2 pixel = clamp(side * block + ivec2(i % around, i / around) - 1, ivec2(0), last);
        vec3 light = lightAt(pixel);
        float radius = cocAt(pixel);
        float bright = brightness(light) * float(highlightShare(light, radius, darkness, params.block) > 0.0);
        c = bright > brightest ? radius : c;
        brightest = max(brightest, bright);
    }
    vec3 sum = vec3(0.0);
    vec4 moments = vec4(0.0);  // of brightness: x, y, squared length, sum
    int end = brightest > 0.0 ? side * side : 0;
    for (int i = 0; i < end; ++i) {
        ivec2 pixel = side * block + ivec2(i % side, i / side);
        vec3 light = lightAt(min(pixel, last));
        float share = any(greaterThan(pixel, last)) ? 0.0 : highlightShare(light, cocAt(min(pixel, last)), darkness, params.block);
        vec2 at = vec2(i % side, i / side) + 0.5;
        sum += share * light;
        moments += share * brightness(light) * vec4(at, dot(at, at), 1.0);
    }
    // Cells, and the list, change where there is a highlight.
    end = moments.w > 0.0 ? cells * cells : 0;
    for (int i = 0; i < end; ++i) {
        ivec2 cell = cells * block + ivec2(i % cells, i / cells);
        int inside = all(lessThan(cell, ivec2(params.half2))) ? 1 : 0;
        for (int j = 0; j < inside; ++j) {
            splitCell(cell, darkness);
        }
    }
    moments.xyz /= max(moments.w, 1e-9);
    float spread = max(moments.z - dot(moments.xy, moments.xy), 0.0);
    float edge2 = max(6.0 * spread - 1.0, 1.0);  // of a disk of the light's own size; antialiasing has spread it
    float radius2 = max(c * c - edge2 / 12.0, 0.25);
    vec3 light = min(sum * params.disk / (radius2 + edge2 / 12.0), 65504.0);
    vec2 corner = vec2(side * inTile);
    imageStore(highlights, block, vec4(light, c));
    imageStore(highlightShape, block, vec4(corner + moments.xy, sqrt(radius2), inversesqrt(edge2)));
}
