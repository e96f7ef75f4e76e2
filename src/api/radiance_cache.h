// Radiance caches of the C API, while a view's lobe is recorded.
#pragma once

#include "api/handles.h"

#include <memory>
#include <mutex>

namespace reflet::api {

/// The cache of a handle. Throws Failure if it is none of the view's context.
std::shared_ptr<RefletRadianceCache_T> heldCache(RefletRadianceCache handle, const RefletView_T& view);

/// The frame's diffuse lobe feeds and reads a cache as long as this exists; other views that share it wait. An
/// exception that ends it makes the cache forget all, as passes that filled it may not have been recorded.
class CacheUse {
public:
    /// cache: may be none.
    CacheUse(RefletView_T& view, Frame& frame, const Settings& settings, std::shared_ptr<RefletRadianceCache_T> cache);
    ~CacheUse();
    CacheUse(const CacheUse&) = delete;
    CacheUse& operator=(const CacheUse&) = delete;

private:
    Frame& frame_;
    std::shared_ptr<RefletRadianceCache_T> cache_;
    std::unique_lock<std::mutex> lock_;
    int exceptions_;
};

}  // namespace reflet::api
