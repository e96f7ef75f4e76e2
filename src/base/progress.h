// Progress of long work on a terminal: how far, and the time left. Silent unless standard error is a terminal, and with
// setQuiet (base/message.h).
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <thread>

namespace reflet {

/// Ends work on a terminal by saying where its result is: "written: cubes.png".
void tellWritten(const std::string& what);

/// Says what is going on if it takes longer than a second, where nobody knows how long it will take.
class WaitingNote {
public:
    WaitingNote();
    ~WaitingNote() { end(); }
    WaitingNote(const WaitingNote&) = delete;
    WaitingNote& operator=(const WaitingNote&) = delete;

    /// Ends the note before.
    void begin(std::string text);
    void end();

private:
    bool terminal_;
    std::jthread thread_;
};

class Progress {
public:
    /// rate: "frames an hour", which is shown, too.
    Progress(std::string what, uint64_t total, std::string rate = "");
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance(uint64_t steps = 1) { set(done_ + steps); }
    /// Replaces the total, where it was an estimate.
    void expect(uint64_t total) { total_ = total; }
    /// `done`: in total, not since the last call. `note` is shown after the time left: "noise 0.012".
    void set(uint64_t done, std::string_view note = "");

private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    std::string rate_;
    uint64_t total_;
    uint64_t done_ = 0;
    bool shown_ = false;
    bool terminal_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point printed_ = start_;
};

}  // namespace reflet
