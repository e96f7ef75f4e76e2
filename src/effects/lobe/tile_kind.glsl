// Classifies the surfaces of a tile.
// The includer first defines float loadDepth(ivec2 pixel); MaterialTexel loadMaterial(ivec2 pixel).
#ifndef REFLET_TILE_KIND_GLSL
#define REFLET_TILE_KIND_GLSL

#include "effects/lobe/ray_tiles.glsl"

struct TileContent {
    uint kind;
    uint pixels[2];  // number of pixels that have the lobe, by lobe
    float smoothest;  // lowest roughness of those with a specular lobe; 1 without
};

// Of the pixels from `first` to `end`, exclusive.
TileContent tileContent(ivec2 first, ivec2 end) {
    uint surfaces = 0u;
    uint mirrors = 0u;
    uint glossy = 0u;
    float smoothest = 1.0;
    for (int y = first.y; y < end.y; ++y) {
        for (int i = 0; i < int(rayTileSide); ++i) {  // a known number without branches: the loads of a row are under way at once
            ivec2 pixel = ivec2(min(first.x + i, end.x - 1), y);
            MaterialTexel m = loadMaterial(pixel);
            bool exists = loadDepth(pixel) > 0.0 && first.x + i < end.x;
            bool shines = exists && (m.flags & materialFlagLambert) == 0u;
            surfaces += exists ? 1u : 0u;
            smoothest = shines ? min(smoothest, m.roughness) : smoothest;
            mirrors += shines && m.roughness <= mirrorRoughness ? 1u : 0u;
            glossy += shines && m.roughness > mirrorRoughness ? 1u : 0u;
        }
    }
    uint kind = glossy > 0u ? tileGlossy : (mirrors > 0u ? tileMirror : (surfaces > 0u ? tileMatt : tileSky));
    return TileContent(kind, uint[2](surfaces, glossy + mirrors), smoothest);
}

#endif
