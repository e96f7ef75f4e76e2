// The nested shadow tiles of directional lamps.
#pragma once

#include "effects/shadow/lamp_shadow.h"

namespace reflet {

/// What directional lamps cast shadows in.
struct LampShadowScene {
    Aabb bounds;           ///< of all casters and receivers; world space
    vec3 eye{0.0F};        ///< of the camera, around whose view the finer tiles lie
    vec3 ahead{0, 0, -1};  ///< unit, the direction of its view
};

/// index: of the lamp in its block. tileSize: texels along each side. The first tile covers the scene. The others lie
/// in steps of a sixteenth of their width on a grid fixed in the world, so that shadow edges do not shimmer under
/// camera motion and few movements draw the maps again.
LampShadow nestedShadow(const LampParams& lamp, uint32_t index, uint32_t firstTile, uint32_t tileSize,
                        const LampShadowScene& scene);

/// Into the clip space of a tile: orthographic, depth reversed.
mat4 worldToNestedTile(const LampShadow& shadow, uint32_t tile);

}  // namespace reflet
