// Interrupts (Ctrl-C, or a request to end) of long work that can stop where something whole is done.
#pragma once

#include <csignal>

namespace reflet {

/// While it lives, the first interrupt is only noted; the second one ends the program.
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
