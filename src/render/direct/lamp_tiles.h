// Which lamps may light which tile of the screen, so that direct light looks at no others. Shared by C++ and GLSL.
//
// Tiled deferred lighting (O. Olsson, U. Assarsson, Tiled Shading, 2011), with a bit for each lamp in place of a list
// of indices: lamps keep their order, so that sums round as without tiles, and no list is too short.
#ifndef REFLET_RENDER_LAMP_TILES_H
#define REFLET_RENDER_LAMP_TILES_H

#include "base/shared.h"
#include "render/lamps.h"
#include "render/view.h"

SHARED_BEGIN

#define DIRECT_SETTINGS(VALUE, SWITCH, CHOICE)                                                                      \
    SWITCH(lampTiles, 1,                                                                                            \
           "Find out first which lamps reach which part of the picture, and look at those alone; else every pixel " \
           "looks at every lamp. The light is the same.")
SETTINGS(DirectSettings, DIRECT_SETTINGS)

const uint lampTileShift = 4;  // a tile has 16x16 pixels
const uint lampTileSide = 1u << lampTileShift;

// Lamp i is bit i % 32 of component i / 32 % 4 of layer i / 128 of the tile's texel.
const uint lampsPerLayer = 128;

struct LampTilesParams {
    ViewParams view;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"

namespace reflet {

/// Of the screen's tiles, rounded up to whole ones.
struct LampTiles {
    gpu::Image masks;  ///< RGBA32_UINT, layers as lampsPerLayer says
    gpu::Image count;  ///< R32F: number of lamps in the mask
};

/// No lamp is missing that brings light to a surface of the tile. Tiles without a surface have none.
LampTiles findLampTiles(gpu::Frame& f, gpu::Image depth, const LampBlock& lamps, const ViewParams& view);

}  // namespace reflet
#endif

#endif
