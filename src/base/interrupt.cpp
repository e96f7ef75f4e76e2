// Handles interrupts of long work.
#include "base/interrupt.h"

namespace reflet {

namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

InterruptNote::InterruptNote() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = 1; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &oldInterrupt_);
    sigaction(SIGTERM, &action, &oldTerminate_);
}

InterruptNote::~InterruptNote() {
    sigaction(SIGINT, &oldInterrupt_, nullptr);
    sigaction(SIGTERM, &oldTerminate_, nullptr);
}

bool InterruptNote::arrived() {
    return interrupted != 0;
}

}  // namespace reflet
