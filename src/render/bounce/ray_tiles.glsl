// Tiles of rays as the passes share them: their texels, their list, the rays of their pixels.
#ifndef REFLET_RAY_TILES_GLSL
#define REFLET_RAY_TILES_GLSL

#include "render/bounce/ray_tiles.h"

// Items of the list: a tile's coordinates, 16 bits each. Its groups come in rows of so many.
uint packTilePlace(uvec2 tile) {
    return tile.x | (tile.y << 16u);
}
uvec2 unpackTilePlace(uint item) {
    return uvec2(item & 0xffffu, item >> 16u);
}

// 0 to rayShares - 1, each once in a tile, neighbours far apart: Bayer's matrix.
uint bayerIndex(uvec2 pixel) {
    uint x = pixel.x ^ pixel.y;
    uint y = pixel.y;
    return ((x & 1u) << 5u) | ((y & 1u) << 4u) | ((x & 2u) << 2u) | ((y & 2u) << 1u) | ((x & 4u) >> 1u) |
           ((y & 4u) >> 2u);
}

// Rays that a pixel of the tile traces in this frame. rays: what the tile's texel says. Their sum over a whole tile is
// just what the tile is to get; turns go by the golden ratio, which spreads those of one pixel evenly over the frames.
uint pixelRays(float rays, uvec2 pixel, uint frame) {
    const uint turn = 39u;  // rayShares / 1.618, odd
    return (uint(rays * float(rayShares)) + ((bayerIndex(pixel) + turn * frame) % rayShares)) / rayShares;
}

#endif
