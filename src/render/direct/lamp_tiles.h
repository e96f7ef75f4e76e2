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

#define DIRECT_SETTINGS(VALUE, SWITCH, CHOICE)                                                                     \
    SWITCH(lampTiles, 1,                                                                                           \
           "Tiled light culling: find the lamps that reach each 16x16 pixel tile and shade with those only. Off: " \
           "every pixel evaluates every lamp. The image is the same.")
SETTINGS(DirectSettings, DIRECT_SETTINGS)

struct LampTilesParams {
    ViewParams view;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"

namespace reflet {

/// Of the screen's tiles, as many as touch it.
struct LampTiles {
    gpu::Image masks;  ///< as lamps.h says
    gpu::Image count;  ///< R32F: number of lamps that may light the tile; none without lamps
};

/// No lamp is missing that brings light to a surface of the tile; with lampTiles off every tile has all lamps.
LampTiles findLampTiles(gpu::Frame& f, gpu::Image depth, const LampBlock& lamps, const ViewParams& view,
                        const DirectSettings& settings);

}  // namespace reflet
#endif

#endif
