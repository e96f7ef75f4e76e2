// Records tiled light culling.
#include "effects/direct/lamp_tiles.h"

#include <algorithm>

namespace reflet {

LampTiles findLampTiles(gpu::PassList& f, gpu::Image depth, const LampBlock& lamps, const ViewParams& view,
                        const DirectSettings& settings) {
    const uvec2 tiles = (depth.size + lampTileSide - 1U) / lampTileSide;
    const uint32_t layers = std::max((lamps.count + lampsPerLayer - 1) / lampsPerLayer, 1U);
    LampTiles found{f.image("lamp_tiles", VK_FORMAT_R32G32B32A32_UINT, tiles, layers, /*array=*/true), {}};
    if (lamps.count == 0) {
        return found;
    }
    found.count = f.image("lamp_count", VK_FORMAT_R32_SFLOAT, tiles);
    constexpr uint32_t threads = 8;  // along each side of a tile's thread group
    f.compute("lamp_tiles", "lamp_tiles.comp")
        .read("depth", depth)
        .write("masks", found.masks)
        .write("lampCount", found.count)
        .params(LampTilesParams{view})
        .params(lamps, "lampBlock")
        .constant("all", settings.lampTiles != 0 ? 0 : 1)
        .dispatch(tiles * threads);
    return found;
}

}  // namespace reflet
