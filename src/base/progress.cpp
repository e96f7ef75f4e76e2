// Progress of long work on a terminal.
#include "base/progress.h"

#include "base/message.h"
#include "base/visible_text.h"

#include <fmt/format.h>

#include <unistd.h>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <system_error>

namespace reflet {

namespace {

constexpr std::chrono::milliseconds patience(500);  // work shorter than this shows nothing
constexpr std::chrono::seconds notePatience(1);
constexpr double secondsPerHour = 3600.0;

std::string durationText(double seconds) {
    const auto whole = std::llround(seconds);
    return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{}:{:02} min", whole / 60, whole % 60);
}

bool showsProgress() {
    return isatty(STDERR_FILENO) != 0 && !isQuiet();
}

}  // namespace

void tellWritten(const std::string& what) {
    if (showsProgress()) {
        printRaw(fmt::format("written: {}\n", visibleText(what)));
    }
}

WaitingNote::WaitingNote() : terminal_(showsProgress()) {}

void WaitingNote::begin(std::string text) {
    end();
    if (!terminal_) {
        return;
    }
    try {
        thread_ = std::jthread([text = std::move(text)](const std::stop_token& stop) {
            std::mutex mutex;
            std::condition_variable_any stopped;
            std::unique_lock lock(mutex);
            stopped.wait_for(lock, stop, notePatience, [] { return false; });
            if (stop.stop_requested()) {
                return;
            }
            printRaw(fmt::format("\r\033[K{}", visibleText(text)));
            stopped.wait(lock, stop, [] { return false; });
            printRaw("\r\033[K");
        });
    } catch (const std::system_error&) {  // without a thread nothing is said
        return;
    }
}

void WaitingNote::end() {
    thread_ = {};
}

Progress::Progress(std::string what, uint64_t total, std::string rate)
    : what_(std::move(what)), rate_(std::move(rate)), total_(total), terminal_(showsProgress()) {}

Progress::~Progress() {
    if (shown_) {
        printRaw("\r\033[K");
    }
}

void Progress::set(uint64_t done, std::string_view note) {
    done_ = done;
    const Clock::time_point now = Clock::now();
    if (!terminal_ || done_ == 0 || done_ >= total_ || now - printed_ < patience) {
        return;
    }
    printed_ = now;
    shown_ = true;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double left = elapsed / static_cast<double>(done_) * static_cast<double>(total_ - done_);
    std::string line =
        fmt::format("\r\033[K{} {} of {}, {} left", visibleText(what_), done_, total_, durationText(left));
    if (!rate_.empty()) {
        line += fmt::format(", {:.0f} {}", static_cast<double>(done_) / elapsed * secondsPerHour, visibleText(rate_));
    }
    printRaw(line + (note.empty() ? "" : ", ") + visibleText(note));
}

}  // namespace reflet
