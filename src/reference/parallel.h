// A parallel loop on oneTBB's threads that ThreadSanitizer understands.
#pragma once

#include <tbb/parallel_for.h>

#include <cstdint>

#ifdef __SANITIZE_THREAD__
// The packaged oneTBB is not compiled with ThreadSanitizer, which thus sees no order between the start of a loop, its
// bodies and its end, and would report everything that they share.
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace reflet {

/// Calls body(0) to body(count - 1), on several threads, and returns when all are done.
template <class Body>
void parallelFor(uint32_t count, const Body& body) {
#ifdef __SANITIZE_THREAD__
    char begun = 0;
    char ended = 0;
    __tsan_release(&begun);
    tbb::parallel_for(0U, count, [&](uint32_t i) {
        __tsan_acquire(&begun);
        body(i);
        __tsan_release(&ended);
    });
    __tsan_acquire(&ended);
#else
    tbb::parallel_for(0U, count, body);
#endif
}

}  // namespace reflet
