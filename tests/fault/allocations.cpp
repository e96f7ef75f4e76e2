// Replaces the allocation functions of the program, also for shared libraries.
#include "fault/allocations.h"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace reflet::fault {

namespace {

std::atomic<bool> counting = false;
std::atomic<bool> ofMalloc = false;
std::atomic<bool> alwaysFails = false;
std::atomic<uint64_t> toFail = 0;
std::atomic<uint64_t> counted = 0;
std::atomic<int64_t> alive = 0;

bool fails(bool isMalloc) noexcept {
    if (!counting || ofMalloc != isMalloc) {
        return false;
    }
    const uint64_t number = ++counted;
    return toFail != 0 && (number == toFail || (number > toFail && alwaysFails));
}

void* allocate(size_t size, size_t alignment) noexcept {
    if (fails(false)) {
        return nullptr;
    }
    void* memory = alignment > alignof(std::max_align_t)
                       ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                       : std::malloc(size == 0 ? 1 : size);
    if (memory != nullptr && counting) {
        ++alive;
    }
    return memory;
}

void* allocateOrThrow(size_t size, size_t alignment) {
    if (void* memory = allocate(size, alignment)) {
        return memory;
    }
    throw std::bad_alloc();
}

void release(void* memory) noexcept {
    if (memory != nullptr && counting) {
        --alive;
    }
    std::free(memory);
}

}  // namespace

FailingAllocation::FailingAllocation(Allocator allocator, uint64_t number, bool always) {
    ofMalloc = allocator == Allocator::malloc;
    alwaysFails = always;
    toFail = number;
    counted = 0;
    alive = 0;
    counting = true;
}

FailingAllocation::~FailingAllocation() {
    counting = false;
}

void FailingAllocation::stop() {
    toFail = 0;
}

uint64_t FailingAllocation::count() {
    return counted;
}

int64_t FailingAllocation::live() {
    return alive;
}

}  // namespace reflet::fault

// NOLINTBEGIN(misc-new-delete-overloads)
void* operator new(size_t size) {
    return reflet::fault::allocateOrThrow(size, 0);
}
void* operator new[](size_t size) {
    return reflet::fault::allocateOrThrow(size, 0);
}
void* operator new(size_t size, std::align_val_t alignment) {
    return reflet::fault::allocateOrThrow(size, static_cast<size_t>(alignment));
}
void* operator new[](size_t size, std::align_val_t alignment) {
    return reflet::fault::allocateOrThrow(size, static_cast<size_t>(alignment));
}
void* operator new(size_t size, const std::nothrow_t& /*tag*/) noexcept {
    return reflet::fault::allocate(size, 0);
}
void* operator new[](size_t size, const std::nothrow_t& /*tag*/) noexcept {
    return reflet::fault::allocate(size, 0);
}
void operator delete(void* memory) noexcept {
    reflet::fault::release(memory);
}
void operator delete[](void* memory) noexcept {
    reflet::fault::release(memory);
}
void operator delete(void* memory, size_t /*size*/) noexcept {
    reflet::fault::release(memory);
}
void operator delete[](void* memory, size_t /*size*/) noexcept {
    reflet::fault::release(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
    reflet::fault::release(memory);
}
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept {
    reflet::fault::release(memory);
}
void operator delete(void* memory, size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
    reflet::fault::release(memory);
}
void operator delete[](void* memory, size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
    reflet::fault::release(memory);
}
// NOLINTEND(misc-new-delete-overloads)

// Sanitizers have a malloc of their own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);

// Also what operator new calls.
void* malloc(size_t size) {
    if (reflet::fault::fails(true)) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
    if (reflet::fault::fails(true)) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) {
    if (reflet::fault::fails(true)) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_realloc(memory, size);
}
}
#endif
