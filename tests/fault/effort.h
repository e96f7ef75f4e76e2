// How much the tests of faults try.
#pragma once

#include <cstdlib>

namespace reflet::fault {

/// Whether many faults are to be tried, for minutes (tests/fault/all.sh), not a few.
inline bool testsAll() {
    return std::getenv("REFLET_FAULT_ALL") != nullptr;  // NOLINT(concurrency-mt-unsafe): one thread
}

}  // namespace reflet::fault
