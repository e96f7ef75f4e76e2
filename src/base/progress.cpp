// Progress of long work on a terminal.
#include "base/progress.h"

#include "base/message.h"

#include <fmt/format.h>

#include <unistd.h>
#include <cmath>

namespace reflet {

namespace {

constexpr std::chrono::milliseconds patience(500);  // work shorter than this shows nothing

std::string durationText(double seconds) {
    const auto whole = std::llround(seconds);
    return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{}:{:02} min", whole / 60, whole % 60);
}

}  // namespace

void tellWritten(const std::string& what) {
    if (isatty(STDERR_FILENO) != 0) {
        printRaw(fmt::format("written: {}\n", what));
    }
}

Progress::Progress(std::string what, uint64_t total)
    : what_(std::move(what)), total_(total), terminal_(isatty(STDERR_FILENO) != 0) {}

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
    printRaw(fmt::format("\r\033[K{} {} of {}, {} left{}{}", what_, done_, total_, durationText(left),
                         note.empty() ? "" : ", ", note));
}

}  // namespace reflet
