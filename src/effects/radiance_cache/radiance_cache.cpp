// Records the upkeep of the radiance cache.
#include "effects/radiance_cache/radiance_cache.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet {

namespace {

// Where all light has changed, what was known counts half after so many frames.
constexpr float halfLife = 0.6F;

// What is known in the first frames lacks bounces, as there was nothing to end in: it fades fast.
constexpr uint32_t youth = 12;
constexpr float keptYoung = 0.7F;

// CacheBuffers::samplesToEnd, at rest and when all light has just changed. At rest most cells are fed by first hits
// alone, and the others about once in 40 frames; with the value of unrest frames of builtin:cave take 11 % longer, for
// the same errors.
constexpr float samplesAtRest = 0.03F;
constexpr float samplesInUnrest = 0.5F;
constexpr float unrestKept = 0.85F;  // from frame to frame

// One pixel of each square of so many to each side is a sample. Cells are seen as some ten pixels: so many samples of a
// frame say enough, and at rest a quarter of them.
uint32_t feedStep(uvec2 size, uint32_t rest) {
    constexpr float mostSamples = 60000.0F;
    const auto pixels = static_cast<float>(size.x) * static_cast<float>(size.y);
    const auto step = static_cast<uint32_t>(std::ceil(std::sqrt(pixels / mostSamples)));
    return std::max(step, 1U) * (rest < framesUntilSettled ? 1U : 2U);
}

}  // namespace

gpu::Image rememberedLight(gpu::PassList& f, const CacheBuffers& cache, const RaySurfaces& from) {
    const gpu::Image remembered = f.image("remembered_light", VK_FORMAT_R16G16B16A16_SFLOAT, from.g.depth.size);
    f.compute("remembered_light", "remembered_light.comp")
        .read("depth", from.g.depth)
        .read("normal", from.g.normal)
        .read("geometricNormal", from.g.geometricNormal)
        .write("cacheKeys", cache.keys)
        .write("cacheCells", cache.cells)
        .write("remembered", remembered)
        .params(RememberedLightParams{from.view, cache.cellSize, cache.unit})
        .dispatch(remembered.size);
    return remembered;
}

void feedCache(gpu::PassList& f, const CacheBuffers& cache, const LobeLight& light) {
    const uvec2 size = light.from.g.depth.size;
    const uint32_t step = feedStep(size, light.from.view.rest);
    f.compute("feed_cache", "feed_cache.comp")
        .read("depth", light.from.g.depth)
        .read("normal", light.from.g.normal)
        .read("radiance", light.radiance)
        .write("cacheKeys", cache.keys)
        .write("cacheCells", cache.cells)
        .params(FeedCacheParams{light.from.view, cache.cellSize, cache.unit, step})
        .dispatch((size + step - 1U) / step);
}

void RadianceCache::allocate(gpu::Context& context) {
    if (!cells_.view()) {
        keys_ = gpu::storageBuffer(context, cacheSlots * sizeof(uint32_t), "radiance_cache.keys");
        cells_ = gpu::storageBuffer(context, cacheSlots * sizeof(CacheCell), "radiance_cache.cells");
    }
}

CacheBuffers RadianceCache::update(gpu::PassList& f, const RadianceCacheSettings& settings, float change,
                                   float exposure) {
    allocate(f.context());
    CacheBuffers cache{keys_.view(), cells_.view()};
    const bool kept = holds_ && !f.isDiscarded(list_);
    if (!kept) {
        holds_ = true;
        list_ = f.listNumber();
        f.promise();
    }
    frames_ = kept ? frames_ + 1 : 0;
    const float atRest = 1.0F - 1.0F / static_cast<float>(settings.history);
    const float changed = std::min(atRest, std::exp2(-1.0F / halfLife));
    const float keep = glm::mix(atRest, changed, std::clamp(change, 0.0F, 1.0F));
    unrest_ = std::max({unrestKept * unrest_, std::clamp(change, 0.0F, 1.0F), frames_ < youth ? 1.0F : 0.0F});
    cache.samplesToEnd = glm::mix(samplesAtRest, samplesInUnrest, unrest_);
    cache.cellSize = settings.cellSize;
    const float unitChange = exposure / std::exchange(exposure_, exposure);
    f.compute("settle_cache", "settle_cache.comp")
        .write("cacheKeys", cache.keys)
        .write("cacheCells", cache.cells)
        .params(SettleCacheParams{frames_ < youth ? std::min(keep, keptYoung) : keep, kept ? ~0U : 0U, unitChange})
        .dispatch(cacheSlots);
    return cache;
}

}  // namespace reflet
