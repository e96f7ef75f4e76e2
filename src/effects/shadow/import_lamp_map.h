// Import of a host's shadow maps of lamps: 2D maps, tiles of an atlas and cube maps, with any depth, become tiles of
// the atlas that lampVisibility reads. Shared by C++ and GLSL.
//
// Where a tile has the projection and the size of the host's map, each of its texels is one of the host's.
#ifndef REFLET_EFFECTS_IMPORT_LAMP_MAP_H
#define REFLET_EFFECTS_IMPORT_LAMP_MAP_H

#include "base/shared.h"
#include "effects/shadow/lamp_shadow.h"

SHARED_BEGIN

const uint lampDepthReversed = 0;  // of the host's matrices, or of nearPlane and farPlane: 1 near, 0 far
const uint lampDepthStandard = 1;  // 0 near, 1 far
const uint lampDistance = 2;       // straight from the lamp, in units of 1 / distanceScale metres; 0: nothing is there

struct ImportLampParams {
    mat4 worldToClip[cubeFaces];  // of the host's maps, y down; by face
    vec4 tiles[cubeFaces];        // of the host's image: first texel, texels
    vec4 position;                // of the lamp
    vec4 tileX;                   // axes of a single tile, unit
    vec4 tileY;
    vec4 tileZ;
    float halfTangent;  // this and what follows as of LampShadow
    float near;
    uint firstTile;
    uint faces;      // tiles of the atlas, 1 or cubeFaces
    uint hostFaces;  // of the host's image, 1 or cubeFaces; of a cube map not used
    uint side;       // texels of a tile
    uint cell;       // texels from tile to tile
    uint columns;
    uint depth;           // one of the three above
    float distanceScale;  // to metres
    float nearPlane;      // of a cube map's faces [m]
    float farPlane;       // infinity: none
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

namespace reflet {

/// R32F: an atlas, as lampVisibility reads it, with nothing in it.
gpu::Image lampAtlas(gpu::PassList& f, const LampShadows& shadows);

/// Writes the tiles of one lamp. map: 2D, or a view of a cube.
void importLampMap(gpu::PassList& f, gpu::Image map, bool isCube, const ImportLampParams& params, gpu::Image atlas);

}  // namespace reflet
#endif

#endif
