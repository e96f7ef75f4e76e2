// Handles interrupts (SIGINT, SIGTERM) of long work, so that it can stop after a complete step.
#pragma once

#include <csignal>

namespace reflet {

/// While an object exists, the first interrupt only sets a flag; the second one ends the program.
class InterruptNote {
public:
    InterruptNote();
    ~InterruptNote();
    InterruptNote(const InterruptNote&) = delete;
    InterruptNote& operator=(const InterruptNote&) = delete;
    InterruptNote(InterruptNote&&) = delete;
    InterruptNote& operator=(InterruptNote&&) = delete;

    [[nodiscard]] static bool arrived();

private:
    struct sigaction oldInterrupt_ {};
    struct sigaction oldTerminate_ {};
};

}  // namespace reflet
