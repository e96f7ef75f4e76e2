// Moves the highlights of each tile to the start of its blocks. In and out: highlights. Out: their count, how far the largest
// reaches [pixels], darkness of the tile.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };
layout(rgba16f) uniform readonly image2D tiles;
layout(rgba16f) uniform image2D highlights;
layout(rgba16f) uniform image2D highlightShape;
layout(rgba16f) uniform writeonly image2D lists;

int side = tileBlocks(params.block);

ivec2 inBlocks(int i) { return ivec2(i % side, i / side); }

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, imageSize(tiles)))) {
        return;
    }
    float darkness = imageLoad(tiles, tile).a;
    ivec2 first = tile * side;
    ivec2 last = imageSize(highlights) - 1;
    int count = 0;
    float reach = 0.0;
    int end = darkness > 0.0 ? side * side : 0;
    for (int i = 0; i < end; ++i) {
        ivec2 at = first + inBlocks(i);
        ivec2 from = min(at, last);
        vec4 light = imageLoad(highlights, from);
        vec4 shape = imageLoad(highlightShape, from);
        int found = all(equal(at, from)) && light.a != 0.0 ? 1 : 0;
        for (int j = 0; j < found; ++j) {
            imageStore(highlights, first + inBlocks(count), light);
            imageStore(highlightShape, first + inBlocks(count), shape);
        }
        count += found;
        reach = found != 0 ? max(reach, shape.z + 0.5 / shape.w) : reach;
    }
    imageStore(lists, tile, vec4(count, reach, count > 0 ? darkness : 0.0, 0.0));
}
