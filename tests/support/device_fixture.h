// One Vulkan device for all tests of a process, with validation and synchronization validation. A validation message
// fails the test that caused it; one at destruction (such as a leak) fails the run.
#pragma once

#include "device/device.h"
#include "device/frame.h"

#include <gtest/gtest.h>

namespace reflet::test {

class DeviceTest : public ::testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    /// Created on first use, with the renderer's shaders registered.
    static gpu::Device& device();
    /// A frame of that device, also shared: neither recording nor pending between tests.
    static gpu::Frame& frame();
    /// Makes the device's writes to buffers visible to the host, which waiting alone does not.
    static void showToHost();

private:
    size_t messagesBefore_ = 0;
};

}  // namespace reflet::test
