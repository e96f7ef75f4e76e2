// Shadows of lamps: shadow maps in one atlas, looked up per pixel (hard, PCF, PCSS). Shared by C++ and GLSL.
//
// A reflected sun has one tile, of what is between its mirror and the surfaces, and of what is between the sun and the
// mirror, as the mirror shows it.
// A spot has one tile that covers its cone; a point lamp, or a spot wider than 60 degrees to each side, six: the faces
// of a cube. Each of these tiles is a perspective view from the lamp.
// A directional lamp has nested orthographic tiles (clipmap): the first covers the scene, each of the others is half as
// wide and lies closer around what is in front of the camera. A receiver reads the finest tile that contains it.
#ifndef REFLET_EFFECTS_LAMP_SHADOW_H
#define REFLET_EFFECTS_LAMP_SHADOW_H

#include "base/shared.h"
#include "effects/lamps.h"
#include "effects/shadow/shadow.h"
#include "effects/view.h"

SHARED_BEGIN

const uint maxShadowedLamps = 16;
const uint cubeFaces = 6;  // +X -X +Y -Y +Z -Z
const uint nestedTiles = 4;

// Limit of the blocker search to the side of a receiver and beyond a spot cone's edge, as a tangent seen from the lamp.
// Blockers at least ten lamp radii from the lamp are always found.
const float lampSearchTangent = 0.1;

// Tile space: x and y across, z along the tile's axis, from the lamp, in metres. Face 2a or 2a + 1 of a cube has the
// axes a + 1, a + 2 (modulo 3) for x and y, and plus or minus a for z. Of a directional lamp, lamp.position is the
// middle of the first tile, on the near plane of all tiles; they have the same axes.
struct LampShadow {
    LampParams lamp;
    uint index;         // of the lamp, among all lamps
    mat3 worldToTile;   // of directions, for a single tile
    float halfTangent;  // the tile reaches to ±halfTangent · z along x and y. Directional: half the width of the first
                        // tile [m]
    float near;      // geometry closer along z casts no shadow; depth = near / z [m]. Directional: depth range of the
                     // tiles [m]; depth = 1 - z / near
    uint firstTile;  // in the atlas, rows from the top
    uint tiles;      // 1, cubeFaces or nestedTiles
    uint side;       // texels that its maps have of LampShadows::tileSize; 0: all
    vec2 middle1;    // directional: x and y of the middles of the tiles after the first, in tile space [m]
    vec2 middle2;
    vec2 middle3;
};

struct LampShadows {
    uint count;
    uint tileSize;   // texels along each side
    uint columns;    // tiles in a row of the atlas
    vec3 boundsMin;  // directional lamps: bounds of all casters
    vec3 boundsMax;
    LampShadow lamps[maxShadowedLamps];
};

// Flag of a draw into a tile: mirrored in LampTileParams::mirror.
const uint reflectedInTile = 0x80000000u;

struct LampTileParams {
    mat4 worldToTile[maxShadowedLamps * cubeFaces];  // into clip space
    vec4 mirror[maxShadowedLamps];                   // of a lamp that is a reflected sun: plane of its mirror; else 0
};

struct LampVisibilityParams {
    ViewParams view;
    ShadowSettings settings;
};

SHARED_END

#ifdef __cplusplus

#include "effects/gbuffer/gbuffer.h"
#include "gpu/pass_list.h"

namespace reflet {

struct LampShadowInputs {
    gpu::Image map;    ///< the atlas
    gpu::Image masks;  ///< lamp bit masks per tile, see lamps.h
    gpu::BufferView blueNoise;
};

/// RGBA8, a layer per four lamps, a channel each: 1 lit; 0 in shadow and out of the lamp's range or cone.
gpu::Image lampVisibility(gpu::PassList& f, const GBuffer& g, const LampShadowInputs& in, const LampShadows& shadows,
                          const LampVisibilityParams& params);

}  // namespace reflet
#endif

#endif
