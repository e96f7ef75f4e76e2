// A recorder with a command buffer of its own: submits what is recorded and waits for it. One frame at a time.
#pragma once

#include "gpu/recorder.h"

#include <chrono>
#include <cstdint>
#include <functional>

namespace reflet::gpu {

class Device;

/// Thrown by a frame that runs pass by pass and was told to stop.
struct FrameStopped {};

class Frame : public Recorder {
public:
    explicit Frame(Device& device);
    ~Frame();

    /// Starts recording. Requires that `wait` was called for the last frame.
    void begin();
    /// Until submit(), finishes each pass that is listed from now on before the next one is recorded, and calls `stop`
    /// in between. If that returns true, submit() throws FrameStopped: the passes so far have run, and the frame is
    /// abandoned; call forget() before the next one. For devices on which a pass takes much longer than a submission.
    void runPassByPass(std::function<bool()> stop);
    /// Submits the recorded commands.
    void submit();
    /// Blocks until the device is done; pass times and read-backs are available then.
    void wait();

    /// Milliseconds of host time from the submission of the last frame waited for until its completion was known.
    [[nodiscard]] double submittedMs() const { return submittedMs_; }

    [[nodiscard]] Device& device() { return device_; }

private:
    void beginCommands();
    void runCommands(const std::function<bool()>& stop);

    Device& device_;
    VkCommandPool commandPool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    uint64_t serial_ = 0;
    std::chrono::steady_clock::time_point submitted_;
    bool submittedPasses_ = false;  ///< the frame's first passes were submitted by themselves
    double submittedMs_ = 0.0;
};

}  // namespace reflet::gpu
