// Tiles of 8x8 pixels of the traced grid: material class and rays per pixel of each, and a list of the tiles with rays.
// Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_RAY_TILES_H
#define REFLET_EFFECTS_RAY_TILES_H

#include "base/shared.h"

SHARED_BEGIN

const uint tileSky = 0;     // no surface
const uint tileMatt = 1;    // no surface with a specular lobe
const uint tileGlossy = 2;  // some have one
const uint tileMirror = 3;  // some have one, and all of these are mirrors

const uint rayTileSide = 8;  // pixels of the grid

// Groups per row of the indirect dispatch over a tile list; 65535 rows suffice for the largest frame.
const uint tileListRow = 64;

// Up to this perceptual roughness a lobe is treated as a mirror: it is too narrow to be resolved on screen.
const float mirrorRoughness = 0.01;

// Rays per pixel are multiples of 1 / rayShares. If they are fractional, some pixels of the tile trace one ray more
// than others, changing from frame to frame.
const uint rayShares = 64;

struct ClassifyTilesParams {
    uvec2 size;       // of the grid
    uint rays;        // per pixel
    uint mirrorRays;  // specular rays per pixel of tileMirror
    float roughRays;  // factor on specular rays of rough tiles
};

// Perceptual roughness from which a tile is rough. Smoother reflections show detail that every pixel must trace.
const float roughFrom = 0.3;

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/ray_surfaces.h"
#include "gpu/pass_list.h"

namespace reflet {

/// The tiles of one lobe.
struct RayTiles {
    gpu::Image tiles;       ///< RG32F, a texel per tile: rays per pixel, in multiples of 1 / rayShares; class
    gpu::BufferView list;   ///< of the tiles with rays; header as in ray lists: groups of an indirect dispatch, count
    uint32_t meanRays = 0;  ///< if the number of rays changes from frame to frame: its mean where all trace, else 0
    uint32_t mostRays = 0;  ///< largest number of rays per pixel
};

/// Rays per pixel.
struct RayCounts {
    uint32_t rays = 0;        ///< per pixel
    uint32_t mirrorRays = 0;  ///< where all surfaces of a tile are mirrors: 1 if a mirror's rays are all identical
    float roughRays = 1.0F;   ///< factor on specular rays in rough tiles
};

/// An empty list with room for all tiles.
gpu::BufferView makeTileList(gpu::PassList& f, uvec2 tiles);

/// The same ray count for all pixels in tiles that have the lobe, but for rough tiles.
RayTiles classifyTiles(gpu::PassList& f, const RaySurfaces& from, uint32_t lobe, const RayCounts& counts);

}  // namespace reflet
#endif

#endif
