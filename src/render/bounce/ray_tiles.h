// Tiles of 8x8 pixels of the surfaces that rays leave: what the lobe is like in each, how many rays its pixels get, and
// a list of those that get any. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_RAY_TILES_H
#define REFLET_RENDER_RAY_TILES_H

#include "base/shared.h"

SHARED_BEGIN

const uint tileSky = 0;     // no surface
const uint tileMatt = 1;    // no surface with a specular lobe
const uint tileGlossy = 2;  // some have one
const uint tileMirror = 3;  // some have one, and all that have are mirrors

const uint rayTileSide = 8;  // pixels of the grid

// Groups in a row of the indirect dispatch of a list of tiles; 65535 rows of them are enough for the largest frame.
const uint tileListRow = 64;

// At most this perceptual roughness, a lobe is narrower than anything on the screen.
const float mirrorRoughness = 0.01;

// A tile's rays per pixel are counted in shares of 1 / rayShares: where that is no whole number, some of its pixels
// trace one more than others, and in the next frame others do.
const uint rayShares = 64;

struct ClassifyTilesParams {
    uvec2 size;       // of the grid
    uint rays;        // per pixel
    uint mirrorRays;  // per pixel of specular rays of tileMirror
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/bounce/ray_surfaces.h"

namespace reflet {

/// Tiles of one lobe's rays.
struct RayTiles {
    gpu::Image tiles;       ///< RG32F, a texel for each: rays per pixel, in shares of 1 / rayShares; class
    gpu::BufferView list;   ///< of those with rays; starts as ray lists do: groups of an indirect dispatch, count
    uint32_t meanRays = 0;  ///< of a pixel, where numbers differ from tile to tile and from frame to frame; 0: they
                            ///< do not
};

/// How many rays pixels get.
struct RayCounts {
    uint32_t rays = 0;        ///< per pixel
    uint32_t mirrorRays = 0;  ///< per pixel of tiles that are all mirrors: 1 where all rays of a mirror bring the same
};

/// An empty list for so many tiles.
gpu::BufferView makeTileList(gpu::Frame& f, uvec2 tiles);

/// The same number for all pixels of tiles that have the lobe.
RayTiles classifyTiles(gpu::Frame& f, const RaySurfaces& from, uint32_t lobe, const RayCounts& counts);

}  // namespace reflet
#endif

#endif
