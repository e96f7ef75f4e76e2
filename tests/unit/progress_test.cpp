// What is said on a terminal while work goes on.
#include "base/progress.h"

#include <gtest/gtest.h>

#include <pty.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>

namespace reflet::progress_test {
namespace {

/// Makes standard error a terminal.
class Terminal {
public:
    Terminal() : saved_(::dup(STDERR_FILENO)) {
        int inner = -1;
        EXPECT_EQ(::openpty(&outer_, &inner, nullptr, nullptr, nullptr), 0);
        ::dup2(inner, STDERR_FILENO);
        ::close(inner);
    }
    ~Terminal() { close(); }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    /// All that was written. Standard error is what it was.
    std::string close() {
        if (saved_ < 0) {
            return "";
        }
        ::dup2(saved_, STDERR_FILENO);
        ::close(saved_);
        saved_ = -1;
        std::string all;
        std::array<char, 4096> part{};
        for (ssize_t got = 0; (got = ::read(outer_, part.data(), part.size())) > 0;) {  // ends as nobody can write
            all.append(part.data(), static_cast<size_t>(got));
        }
        ::close(outer_);
        return all;
    }

private:
    int saved_;
    int outer_ = -1;
};

TEST(WaitingNote, IsSaidAfterASecondAndErased) {
    Terminal terminal;
    WaitingNote note;
    note.begin("compiling 3 shaders");
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    note.end();
    EXPECT_EQ(terminal.close(), "\r\033[Kcompiling 3 shaders\r\033[K");
}

TEST(WaitingNote, ShortWorkIsSilent) {
    Terminal terminal;
    {
        WaitingNote note;
        note.begin("compiling 3 shaders");
        note.begin("compiling 1 shaders");
    }
    EXPECT_EQ(terminal.close(), "");
}

TEST(WaitingNote, WithoutATerminalNothingIsSaid) {
    ::testing::internal::CaptureStderr();
    {
        WaitingNote note;
        note.begin("compiling 3 shaders");
        std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace reflet::progress_test
