// Classifies tiles by their materials, sets their rays per pixel and lists the tiles that get rays. One thread per
// tile.
// In: depth, material. Out: rays and class of each tile; the list.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/ray_tiles.h"
#include "effects/lobe/rays.h"
#include "effects/gbuffer/gbuffer.glsl"

layout(constant_id = 0) const uint lobe = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ClassifyTilesParams params; };
uniform sampler2D depth;
uniform sampler2D material;
layout(rg32f) uniform writeonly image2D tiles;
layout(scalar) buffer ListBlock {
    uint groups[3];
    uint count;
    uint items[];
} list;
#include "effects/lobe/ray_tiles_append.glsl"

float loadDepth(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
MaterialTexel loadMaterial(ivec2 pixel) { return unpackMaterial(texelFetch(material, pixel, 0)); }
#include "effects/lobe/tile_kind.glsl"

// The groups go down strips of the image, and so does the list: see base/strips.h.
void main() {
    uvec2 tile = gl_WorkGroupID.yx * gl_WorkGroupSize.xy + gl_LocalInvocationID.xy;
    uvec2 first = tile * rayTileSide;
    if (any(greaterThanEqual(first, params.size))) {
        return;
    }
    TileContent content = tileContent(ivec2(first), ivec2(min(first + rayTileSide, params.size)));
    bool allMirrors = lobe == lobeSpecular && content.kind == tileMirror;
    float rays = float(content.pixels[lobe] == 0u ? 0u : (allMirrors ? params.mirrorRays : params.rays));
    rays *= lobe == lobeSpecular && content.smoothest > roughFrom ? params.roughRays : 1.0;
    imageStore(tiles, ivec2(tile), vec4(rays, content.kind, 0.0, 0.0));
    if (rays > 0.0) {
        appendTile(tile);
    }
}
