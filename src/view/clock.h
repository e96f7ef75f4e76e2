// The clock of the window.
#pragma once

#include <chrono>

namespace reflet {

using Clock = std::chrono::steady_clock;

inline double secondsSince(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

}  // namespace reflet
