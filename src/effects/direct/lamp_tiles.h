// Tiled light culling: finds the lamps that may light each screen tile, so that direct light evaluates no others.
// Shared by C++ and GLSL.
//
// Tiled deferred lighting (O. Olsson, U. Assarsson, Tiled Shading, 2011), with a bit mask of lamps instead of an index
// list: lamps keep their order, so that sums round as without tiles, and no list can overflow.
#ifndef REFLET_EFFECTS_LAMP_TILES_H
#define REFLET_EFFECTS_LAMP_TILES_H

#include "base/shared.h"
#include "effects/lamps.h"
#include "effects/view.h"

SHARED_BEGIN

#define DIRECT_SETTINGS(VALUE, SWITCH, CHOICE)                                                                         \
    SWITCH(lampTiles, 1,                                                                                               \
           "Tiled light culling: find the lamps that reach each 16x16 pixel tile and shade with those only. Off: "     \
           "every pixel evaluates every lamp. The image is the same.")                                                 \
    SWITCH(emitters, 1,                                                                                                \
           "Light surfaces by small bright emissive surfaces as by lamps, with shadow maps (shadow.lamps): diffuse "   \
           "light, and highlights on rough ones. Off: only rays that hit them by chance bring their light, with much " \
           "noise.")                                                                                                   \
    VALUE(uint, reflectedSuns, 0, 0, 4,                                                                                \
          "Flat mirrors that reflect the sun onto other surfaces (caustics), at most, with shadow maps (shadow.lamps " \
          "counts them, too). 0: that light is missing, as rays find it almost never.")
SETTINGS(DirectSettings, DIRECT_SETTINGS)

struct LampTilesParams {
    ViewParams view;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

namespace reflet {

/// Images with a texel per screen tile.
struct LampTiles {
    gpu::Image masks;  ///< as defined in lamps.h
    gpu::Image count;  ///< R32F: number of lamps that may light the tile; none without lamps
};

/// Conservative: includes every lamp that lights a surface of the tile. With lampTiles off, every tile gets all lamps.
LampTiles findLampTiles(gpu::PassList& f, gpu::Image depth, const LampBlock& lamps, const ViewParams& view,
                        const DirectSettings& settings);

}  // namespace reflet
#endif

#endif
