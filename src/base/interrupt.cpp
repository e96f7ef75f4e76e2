// Handles interrupts of long work.
#include "base/interrupt.h"

#include <atomic>

namespace reflet {

namespace {

// The handler runs on any thread, and others ask: more than volatile sig_atomic_t allows.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

InterruptNote::InterruptNote() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = true; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &oldInterrupt_);
    sigaction(SIGTERM, &action, &oldTerminate_);
}

InterruptNote::~InterruptNote() {
    sigaction(SIGINT, &oldInterrupt_, nullptr);
    sigaction(SIGTERM, &oldTerminate_, nullptr);
}

bool InterruptNote::arrived() {
    return interrupted;
}

}  // namespace reflet
