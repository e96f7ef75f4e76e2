// Records the upkeep of the radiance cache.
#include "renderer/radiance_cache/radiance_cache.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

gpu::Image rememberedLight(gpu::PassList& f, const CacheBuffers& cache, const RadianceCacheSettings& settings,
                           const RaySurfaces& from) {
    const gpu::Image remembered = f.image("remembered_light", VK_FORMAT_R16G16B16A16_SFLOAT, from.g.depth.size);
    f.compute("remembered_light", "remembered_light.comp")
        .read("depth", from.g.depth)
        .read("normal", from.g.normal)
        .read("geometricNormal", from.g.geometricNormal)
        .write("cacheKeys", cache.keys)
        .write("cacheCells", cache.cells)
        .write("remembered", remembered)
        .params(RememberedLightParams{from.view, settings.cellSize})
        .dispatch(remembered.size);
    return remembered;
}

CacheBuffers RadianceCache::update(gpu::PassList& f, const RadianceCacheSettings& settings, float change) {
    if (settings.enabled == 0) {
        return {};
    }
    CacheBuffers cache{keys_.get(f, cacheSlots * sizeof(uint32_t)), cells_.get(f, cacheSlots * sizeof(CacheCell))};
    const bool written = keys_.holds(f) && cells_.holds(f);
    const bool kept = written && generation_ == f.generation();
    generation_ = f.generation();
    frames_ = kept ? frames_ + 1 : 0;
    const float atRest = 1.0F - 1.0F / static_cast<float>(settings.history);
    const float changed = std::min(atRest, std::exp2(-1.0F / halfLife));
    const float keep = glm::mix(atRest, changed, std::clamp(change, 0.0F, 1.0F));
    unrest_ = std::max({unrestKept * unrest_, std::clamp(change, 0.0F, 1.0F), frames_ < youth ? 1.0F : 0.0F});
    cache.samplesToEnd = glm::mix(samplesAtRest, samplesInUnrest, unrest_);
    f.compute("settle_cache", "settle_cache.comp")
        .write("cacheKeys", cache.keys)
        .write("cacheCells", cache.cells)
        .params(SettleCacheParams{frames_ < youth ? std::min(keep, keptYoung) : keep, kept ? ~0U : 0U})
        .dispatch(cacheSlots);
    return cache;
}

}  // namespace reflet
