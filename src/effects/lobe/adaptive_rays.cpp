// Records the passes of adaptive sampling: noise per tile, then a ray budget distributed by it.
#include "effects/lobe/adaptive_rays.h"

#include "effects/lobe/rays.h"

#include <algorithm>
#include <array>
#include <span>

namespace reflet {

namespace {

// Bounds relative to the mean: at least leastShare, so that changes are detected soon, and at most mostTimes.
constexpr float leastShare = 0.5F;
constexpr uint32_t mostTimes = 4;

}  // namespace

uint32_t adaptiveRayLimit(gpu::PassList& f, uvec2 size, uint32_t mean) {
    return std::max(raysPerBatch(f, size, std::min(mostTimes * mean, maxAdaptiveRays)), mean);
}

RayTiles shareRays(gpu::PassList& f, gpu::HistoryImage& own, const RaySurfaces& from, uint32_t lobe,
                   const RayCounts& counts, const LobeHistory& past) {
    const uvec2 size = (from.g.depth.size + rayTileSide - 1U) / rayTileSide;
    const gpu::Image noise = f.image("noise", VK_FORMAT_R32G32_SFLOAT, size);
    const gpu::History tiles = own.swap(f, VK_FORMAT_R32G32_SFLOAT, size, gpu::Resample::nearest);
    const gpu::BufferView histogram = f.buffer("noise_histogram", histogramSize * sizeof(uint32_t));
    constexpr std::array<uint32_t, histogramSize> none{};
    f.update(histogram, std::as_bytes(std::span(none)));
    gpu::ComputePass pass = f.compute("measure_noise", "measure_noise.comp");
    bindReflectance(f, pass, from.g)
        .constant("lobe", lobe)
        .read("depth", from.g.depth)
        .read("material", from.g.material)
        .read("baseColor", from.g.baseColor)
        .read("motion", from.g.motion)
        .read("previousLight", past.light)
        .read("previousSurface", past.surface)
        .read("previousMoments", past.moments)
        .read("previousLit", past.lit)
        .read("previousTiles", tiles.previous)
        .write("noise", noise)
        .write("histogram", histogram)
        .params(MeasureNoiseParams{from.view, vec2(past.lit.size) / static_cast<float>(from.scale), past.lit.size,
                                   from.scale, blockPixelOffset(from.scale), past.valid && tiles.valid ? 1U : 0U})
        .dispatch(size);
    const gpu::BufferView list = makeTileList(f, size);
    const auto mean = static_cast<float>(counts.rays);
    const uint32_t most = adaptiveRayLimit(f, from.g.depth.size, counts.rays);
    f.compute("share_rays", "share_rays.comp")
        .constant("lobe", lobe)
        .read("histogram", histogram)
        .read("noise", noise)
        .write("tiles", tiles.next)
        .write("list", list)
        .params(ShareRaysParams{size, counts.rays, counts.mirrorRays, leastShare * mean, static_cast<float>(most)})
        .dispatch(size.x * size.y);
    return {tiles.next, list, counts.rays, most};
}

}  // namespace reflet
