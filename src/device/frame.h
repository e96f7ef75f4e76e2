// A recorder with a command buffer of its own: submits what is recorded and waits for it. One frame at a time.
#pragma once

#include "gpu/recorder.h"

#include <chrono>
#include <cstdint>

namespace reflet::gpu {

class Device;

class Frame : public Recorder {
public:
    explicit Frame(Device& device);
    ~Frame();

    /// Starts recording. Requires that `wait` was called for the last frame.
    void begin();
    /// Submits the recorded commands.
    void submit();
    /// Blocks until the device is done; pass times and read-backs are available then.
    void wait();

    /// Milliseconds of host time from the submission of the last frame waited for until its completion was known.
    [[nodiscard]] double submittedMs() const { return submittedMs_; }

    [[nodiscard]] Device& device() { return device_; }

private:
    Device& device_;
    VkCommandPool commandPool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    uint64_t serial_ = 0;
    std::chrono::steady_clock::time_point submitted_;
    double submittedMs_ = 0.0;
};

}  // namespace reflet::gpu
