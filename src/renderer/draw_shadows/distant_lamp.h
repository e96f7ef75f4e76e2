// The nested shadow tiles (clipmap) of directional lamps.
#pragma once

#include "effects/shadow/lamp_shadow.h"

namespace reflet {

/// The scene and the camera that shadow tiles of directional lamps are fitted to.
struct LampShadowScene {
    Aabb bounds;           ///< bounds of all casters and receivers; world space
    vec3 eye{0.0F};        ///< position of the camera, around whose view the finer tiles lie
    vec3 ahead{0, 0, -1};  ///< unit, view direction of the camera
};

/// index: of the lamp in its block. tileSize: texels along each side. The first tile covers the scene. The others snap
/// to a world-space grid in steps of a sixteenth of their width, so that shadow edges do not shimmer under camera
/// motion, and the maps are rarely redrawn.
LampShadow nestedShadow(const LampParams& lamp, uint32_t index, uint32_t firstTile, uint32_t tileSize,
                        const LampShadowScene& scene);

/// World space to the clip space of a tile: orthographic, reversed depth.
mat4 worldToNestedTile(const LampShadow& shadow, uint32_t tile);

}  // namespace reflet
