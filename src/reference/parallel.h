// A parallel loop.
#pragma once

#ifdef __SANITIZE_THREAD__
#include <tbb/task_arena.h>

#include <atomic>
#include <thread>
#include <vector>
#else
#include <tbb/parallel_for.h>
#endif

#include <cstdint>

namespace reflet {

/// Calls body(0) to body(count - 1), on several threads, and returns when all are done.
template <class Body>
void parallelFor(uint32_t count, const Body& body) {
#ifdef __SANITIZE_THREAD__
    // The packaged oneTBB is not compiled with ThreadSanitizer, which thus sees no order between a loop and what
    // follows.
    std::atomic<uint32_t> next = 0;
    const auto work = [&] {
        for (uint32_t i = next++; i < count; i = next++) {
            body(i);
        }
    };
    std::vector<std::jthread> helpers;
    for (int i = 1; i < tbb::this_task_arena::max_concurrency(); ++i) {
        helpers.emplace_back(work);
    }
    work();
#else
    tbb::parallel_for(0U, count, body);
#endif
}

}  // namespace reflet
