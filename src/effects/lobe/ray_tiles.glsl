// Shared functions of ray tiles: list items and rays per pixel.
#ifndef REFLET_RAY_TILES_GLSL
#define REFLET_RAY_TILES_GLSL

#include "effects/lobe/ray_tiles.h"

// List items: a tile's coordinates, 16 bits each.
uint packTilePlace(uvec2 tile) {
    return tile.x | (tile.y << 16u);
}
uvec2 unpackTilePlace(uint item) {
    return uvec2(item & 0xffffu, item >> 16u);
}

// Bayer matrix: 0 to rayShares - 1, each once per tile, neighbours far apart.
uint bayerIndex(uvec2 pixel) {
    uint x = pixel.x ^ pixel.y;
    uint y = pixel.y;
    return ((x & 1u) << 5u) | ((y & 1u) << 4u) | ((x & 2u) << 2u) | ((y & 2u) << 1u) | ((x & 4u) >> 1u) |
           ((y & 4u) >> 2u);
}

// Rays that a pixel of the tile traces in this frame. rays: the tile's rays per pixel, which may be fractional. The sum
// over a whole tile is exact; the order rotates by the golden ratio, so that each pixel's extra rays are evenly
// distributed over frames.
uint pixelRays(float rays, uvec2 pixel, uint frame) {
    const uint turn = 39u;  // rayShares / 1.618, odd
    return (uint(rays * float(rayShares)) + ((bayerIndex(pixel) + turn * frame) % rayShares)) / rayShares;
}

#endif
