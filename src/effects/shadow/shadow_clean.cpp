// Records the shadow denoiser.
#include "effects/shadow/shadow_clean.h"

namespace reflet {

namespace {

gpu::Image clearedTexels(gpu::PassList& f, const char* name, uvec2 size) {
    const gpu::Image image = f.image(name, VK_FORMAT_R32_UINT, size);
    f.clear(image);
    return image;
}

gpu::BufferView listTiles(gpu::PassList& f, gpu::Image visibility, gpu::Image penumbra, gpu::Image cleaned) {
    const uvec2 tiles = (visibility.size + shadowTileSide - 1U) / shadowTileSide;
    const gpu::BufferView list =
        f.buffer("shadow_clean.tiles", shadowTilesHeader + VkDeviceSize(tiles.x) * tiles.y * sizeof(uint32_t));
    constexpr uint32_t empty[] = {0, 1, 1, 0};
    f.update(list, std::as_bytes(std::span(empty)));
    f.compute("shadow_clean.tiles", "shadow_clean_tiles.comp")
        .read("visibility", visibility)
        .read("penumbra", penumbra)
        .write("cleaned", cleaned)
        .write("tiles", list)
        .params(ShadowTilesParams{visibility.size})
        .dispatch(tiles);
    return list;
}

}  // namespace

gpu::Image denoiseShadow(gpu::PassList& f, gpu::HistoryImage* own, const GBuffer& g, gpu::Image visibility,
                         gpu::Image penumbra, ShadowDenoiseParams params) {
    const uvec2 size = visibility.size;
    const gpu::Image cleaned = f.image("shadow_clean", VK_FORMAT_R8_UNORM, size);
    const gpu::BufferView tiles = listTiles(f, visibility, penumbra, cleaned);
    const gpu::Image gathered = clearedTexels(f, "shadow_clean.gathered", size);
    const gpu::Image blurred = clearedTexels(f, "shadow_clean.blurred", size);
    const gpu::Image kernel = f.image("shadow_clean.kernel", VK_FORMAT_R32G32B32A32_UINT, size);
    params.historyFrames = own != nullptr ? params.historyFrames : 0;
    constexpr VkFormat historyFormat = VK_FORMAT_R32G32_UINT;
    gpu::History history{f.placeholder(historyFormat), f.placeholder(historyFormat)};
    if (params.historyFrames > 0) {
        history = own->swap(f, historyFormat, size, gpu::Resample::depthInGreen);
        f.clear(history.next);
    }
    params.hasPrevious = history.valid ? 1 : 0;
    f.compute("shadow_clean.gather", "shadow_clean_gather.comp")
        .read("tiles", tiles)
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("motion", g.motion)
        .read("visibility", visibility)
        .read("penumbra", penumbra)
        .read("previous", history.previous)
        .write("next", history.next)
        .write("gathered", gathered)
        .write("kernel", kernel)
        .params(params)
        .dispatchIndirect(tiles, 0);
    for (const uint32_t last : {0U, 1U}) {
        f.compute(last == 0 ? "shadow_clean.blur_1" : "shadow_clean.blur_2", "shadow_clean_blur.comp")
            .constant("last", last)
            .read("tiles", tiles)
            .read("from", last == 0 ? gathered : blurred)
            .read("kernel", kernel)
            .read("depth", g.depth)
            .read("visibility", visibility)
            .write("blurred", last == 0 ? blurred : gathered)
            .write("cleaned", cleaned)
            .params(ShadowBlurParams{size, params.samples})
            .dispatchIndirect(tiles, 0);
    }
    return cleaned;
}

}  // namespace reflet
