// Makes the n-th allocation of memory fail: replaces operator new and, without sanitizers, malloc in this program.
#pragma once

#include <cstdint>

namespace reflet::fault {

enum class Allocator : uint8_t { operatorNew, malloc };

/// While it lives, allocations are counted, and that of this number (from 1) fails; always: all later ones as well.
/// number 0: none.
class FailingAllocation {
public:
    FailingAllocation(Allocator allocator, uint64_t number, bool always);
    ~FailingAllocation();
    FailingAllocation(const FailingAllocation&) = delete;
    FailingAllocation& operator=(const FailingAllocation&) = delete;

    /// Ends failing; what is alive is still counted.
    static void stop();
    static uint64_t count();
    /// Allocated and not freed since it was made, by operator new.
    static int64_t live();
};

}  // namespace reflet::fault
