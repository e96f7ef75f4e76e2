// Radiance caches of the C API: their life, and their use by several views.
#include "api/radiance_cache.h"

#include "api/calls.h"
#include "api/frame.h"
#include "api/live.h"

#include <exception>
#include <utility>

namespace reflet::api {

namespace {

// Views with the same frame index are of one frame, unless a view comes again.
CacheBuffers updated(RefletRadianceCache_T& cache, const RefletView_T& view, Frame& frame, const Settings& settings,
                     gpu::PassList& f) {
    const uint32_t index = frame.context.view.frame;
    if (cache.frame != index || cache.settledBy == &view) {
        cache.current = cache.table.update(f, settings.radianceCache, frame.change.light, frame.preExposure);
        cache.frame = index;
        cache.settledBy = &view;
    }
    CacheBuffers buffers = cache.current;
    buffers.cellSize = settings.radianceCache.cellSize;
    buffers.unit = frame.preExposure / cache.table.exposure();
    return buffers;
}

}  // namespace

std::shared_ptr<RefletRadianceCache_T> heldCache(RefletRadianceCache handle, const RefletView_T& view) {
    std::shared_ptr<RefletRadianceCache_T> cache = held(handle, "RefletIndirectLight.radianceCache");
    if (cache->keeps.get() != &view.owner) {
        failArgument("RefletIndirectLight.radianceCache: is of another context than the view");
    }
    return cache;
}

CacheUse::CacheUse(RefletView_T& view, Frame& frame, const Settings& settings,
                   std::shared_ptr<RefletRadianceCache_T> cache)
    : frame_(frame), cache_(std::move(cache)), exceptions_(std::uncaught_exceptions()) {
    if (cache_) {
        lock_ = std::unique_lock(cache_->mutex);
        frame_.context.cache = updated(*cache_, view, frame, settings, view.recorder);
    }
}

CacheUse::~CacheUse() {
    if (cache_) {
        frame_.context.cache = {};
        if (std::uncaught_exceptions() > exceptions_) {
            cache_->table.forget();
            cache_->frame.reset();
        }
    }
}

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletCreateRadianceCache(RefletContext context, RefletRadianceCache* cache) {
    if (cache != nullptr) {
        *cache = nullptr;
    }
    return guarded([&] {
        const std::shared_ptr<RefletContext_T> owner = held(context, "context");
        if (cache == nullptr) {
            failArgument("cache: is NULL");
        }
        checkDevice(*context);
        const std::scoped_lock lock(context->mutex);
        if (context->destroyed) {
            failArgument("context: has been destroyed");
        }
        auto made = std::make_shared<RefletRadianceCache_T>();
        made->table.allocate(*context->gpu);
        made->keeps = owner;
        Live<RefletRadianceCache_T>::add(made);
        ++context->owned;
        *cache = made.get();
    });
}

void refletDestroyRadianceCache(RefletRadianceCache cache) {
    std::shared_ptr<RefletRadianceCache_T> taken = Live<RefletRadianceCache_T>::take(cache);
    if (!taken) {  // NULL, or destroyed before
        return;
    }
    const std::shared_ptr<RefletContext_T> context = taken->keeps;
    taken.reset();  // it goes with the last call that has it, or with rays that wait for answers
    const std::scoped_lock lock(context->mutex);
    --context->owned;
}

RefletResult refletResetRadianceCache(RefletRadianceCache cache) {
    return guarded([&] {
        const std::shared_ptr<RefletRadianceCache_T> known = held(cache, "cache");
        const std::scoped_lock lock(known->mutex);
        known->table.forget();
        known->frame.reset();
    });
}
