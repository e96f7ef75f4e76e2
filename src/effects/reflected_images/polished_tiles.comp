// Copies what pixels show, and lists the tiles with surfaces that are polished enough to show an image. One thread per
// tile. In: depth, motion, material. Out: depth, motion, the list.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer.glsl"
#include "effects/reflected_images/reflected_images.h"

layout(constant_id = 0) const uint moves = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { PolishedTilesParams params; };
uniform sampler2D depth;
uniform sampler2D motion;
uniform sampler2D material;
layout(r32f) uniform writeonly image2D shownDepth;
layout(rg16f) uniform writeonly image2D shownMotion;
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
        for (int i = 0; i < int(rayTileSide); ++i) {  // a known number: the loads of a row are under way at once
            ivec2 pixel = ivec2(min(first.x + i, end.x - 1), y);
            float d = texelFetch(depth, pixel, 0).r;
            float roughness = unpackMaterial(texelFetch(material, pixel, 0)).roughness;
            polished = polished || (d > 0.0 && roughness < roughestImage);
            imageStore(shownDepth, pixel, vec4(d));
            if (moves != 0u) {
                imageStore(shownMotion, pixel, vec4(texelFetch(motion, pixel, 0).rg, 0.0, 0.0));
            }
        }
    }
    if (polished) {
        appendTile(tile);
    }
}
