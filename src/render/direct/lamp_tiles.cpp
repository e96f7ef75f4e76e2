// Records the search for the lamps of every tile.
#include "render/direct/lamp_tiles.h"

namespace reflet {

LampTiles findLampTiles(gpu::Frame& f, gpu::Image depth, const LampBlock& lamps, const ViewParams& view) {
    const uvec2 tiles = (depth.size + lampTileSide - 1U) / lampTileSide;
    const uint32_t layers = (lamps.count + lampsPerLayer - 1) / lampsPerLayer;
    const LampTiles found{f.image("lamp_tiles", VK_FORMAT_R32G32B32A32_UINT, tiles, layers, /*array=*/true),
                          f.image("lamp_count", VK_FORMAT_R32_SFLOAT, tiles)};
    f.compute("lamp_tiles", "lamp_tiles.comp")
        .read("depth", depth)
        .write("masks", found.masks)
        .write("lampCount", found.count)
        .params(LampTilesParams{view})
        .params(lamps, "lampBlock")
        .dispatch(tiles * 8U);
    return found;
}

}  // namespace reflet
