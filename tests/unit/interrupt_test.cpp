// Interrupts, which the kernel delivers to any thread of the program.
#include "base/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <future>
#include <thread>

namespace reflet::interrupt_test {
namespace {

// ThreadSanitizer reports a flag that is not made for this.
TEST(Interrupt, IsSeenByOtherThreads) {
    const InterruptNote note;
    std::promise<void> asks;
    std::thread waiter([&] {
        asks.set_value();
        while (!InterruptNote::arrived()) {
            std::this_thread::yield();
        }
    });
    asks.get_future().wait();
    EXPECT_EQ(::raise(SIGINT), 0);
    waiter.join();
    EXPECT_TRUE(InterruptNote::arrived());
}

}  // namespace
}  // namespace reflet::interrupt_test
