// Records the import of lamps' shadow maps.
#include "effects/shadow/import_lamp_map.h"

#include "gpu/context.h"

namespace reflet {

gpu::Image lampAtlas(gpu::PassList& f, const LampShadows& shadows) {
    const LampShadow& last = shadows.lamps[shadows.count - 1];
    const uint32_t tiles = last.firstTile + last.tiles;
    const uvec2 size = shadows.tileSize * uvec2(shadows.columns, (tiles + shadows.columns - 1) / shadows.columns);
    const gpu::Image atlas = f.image("lamp_atlas", VK_FORMAT_R32_SFLOAT, size);
    f.clear(atlas);
    return atlas;
}

void importLampMap(gpu::PassList& f, gpu::Image map, bool isCube, const ImportLampParams& params, gpu::Image atlas) {
    const VkSampler nearest = f.context().sampler({VK_FILTER_NEAREST, VK_FILTER_NEAREST});
    f.compute("import_lamp", isCube ? "import_lamp_cube.comp" : "import_lamp_map.comp")
        .read("hostMap", map, isCube ? nearest : VK_NULL_HANDLE)
        .write("atlas", atlas)
        .params(params)
        .dispatch(params.side, params.side, params.faces);
}

}  // namespace reflet
