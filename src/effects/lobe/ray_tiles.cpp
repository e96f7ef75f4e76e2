// Records the classification of tiles.
#include "effects/lobe/ray_tiles.h"

#include "effects/lobe/rays.h"

#include <span>

namespace reflet {

gpu::BufferView makeTileList(gpu::PassList& f, uvec2 tiles) {
    const VkDeviceSize items = VkDeviceSize(tiles.x) * tiles.y;
    const gpu::BufferView list = f.buffer("tile_list", rayListHeader + items * sizeof(uint32_t));
    constexpr uint32_t empty[] = {tileListRow, 0, 1, 0};
    f.update(list, std::as_bytes(std::span(empty)));
    return list;
}

RayTiles classifyTiles(gpu::PassList& f, const RaySurfaces& from, uint32_t lobe, const RayCounts& counts) {
    const uvec2 size = (from.g.depth.size + rayTileSide - 1U) / rayTileSide;
    const bool varies = lobe == lobeSpecular && counts.roughRays < 1.0F;
    const RayTiles tiles{f.image("tiles", VK_FORMAT_R32G32_SFLOAT, size), makeTileList(f, size),
                         varies ? counts.rays : 0, counts.rays};
    f.compute("classify_tiles", "classify_tiles.comp")
        .constant("lobe", lobe)
        .read("depth", from.g.depth)
        .read("material", from.g.material)
        .write("tiles", tiles.tiles)
        .write("list", tiles.list)
        .params(ClassifyTilesParams{from.g.depth.size, counts.rays, counts.mirrorRays, counts.roughRays})
        .dispatch(uvec2(size.y, size.x));
    return tiles;
}

}  // namespace reflet
