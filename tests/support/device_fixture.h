// One Vulkan device for all tests of a process, with validation and synchronization validation. A message of theirs
// fails the test that caused it; one at the end (a leak, say) fails the run.
#pragma once

#include "gpu/device.h"
#include "gpu/frame.h"

#include <gtest/gtest.h>

namespace reflet::test {

class DeviceTest : public ::testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    /// Made for the first test that asks. The renderer's shaders are registered.
    static gpu::Device& device();
    /// A frame of that device, shared like it: neither recording nor waiting between tests.
    static gpu::Frame& frame();
    /// Lets the host see what the device wrote to buffers. Waiting for it does not do so by itself.
    static void showToHost();

private:
    size_t messagesBefore_ = 0;
};

}  // namespace reflet::test
