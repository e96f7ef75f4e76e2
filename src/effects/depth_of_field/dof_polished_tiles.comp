// Copies the depth, and lists the tiles with surfaces that are polished enough to show an image. One thread per tile. In: depth,
// material. Out: depth, the list.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/gbuffer/gbuffer.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofPolishedTilesParams params; };
uniform sampler2D depth;
uniform sampler2D material;
layout(r32f) uniform writeonly image2D apparentDepth;
layout(scalar) buffer ListBlock {
    uint groups[3];
    uint count;
    uint items[];
} list;
#include "effects/lobe/ray_tiles_append.glsl"

void main() {
    uvec2 tile = gl_GlobalInvocationID.xy;
    ivec2 first = ivec2(tile * rayTileSide);
    ivec2 end = min(first + int(rayTileSide), ivec2(params.size));
    bool polished = false;
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            float d = texelFetch(depth, ivec2(x, y), 0).r;
            float roughness = unpackMaterial(texelFetch(material, ivec2(x, y), 0)).roughness;
            polished = polished || (d > 0.0 && roughness < dofRoughestImage);
            imageStore(apparentDepth, ivec2(x, y), vec4(d));
        }
    }
    if (polished) {
        appendTile(tile);
    }
}
