// How much the tests of faults try.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace reflet::fault {

/// Whether many faults are to be tried, for many minutes (tests/fault/all.sh), not a few.
inline bool testsAll() {
    return std::getenv("REFLET_FAULT_ALL") != nullptr;  // NOLINT(concurrency-mt-unsafe): one thread
}

/// Then: how many calls of each function between the first and the last one.
inline uint64_t callsBetween() {
    const char* text = std::getenv("REFLET_FAULT_ALL");  // NOLINT(concurrency-mt-unsafe): one thread
    return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
}

}  // namespace reflet::fault
