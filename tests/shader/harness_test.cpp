// Checks that the validation layers report what the other tests rely on them to report.
#include "shader/harness.h"

#include <string>

namespace reflet::test::harness_test {
namespace {

TEST(Validation, noticesTwoWritesWithoutABarrier) {
    gpu::DeviceOptions options;
    options.validation = true;
    gpu::Device device(options);
    const gpu::Buffer buffer(device, 64, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryUse::device, "buffer");
    device.runNow([&](VkCommandBuffer commands) {
        device.vk.vkCmdFillBuffer(commands, buffer.handle(), 0, 64, 1);
        device.vk.vkCmdFillBuffer(commands, buffer.handle(), 0, 64, 2);
    });
    ASSERT_EQ(device.validationMessages().size(), 1U);
    EXPECT_NE(device.validationMessages().front().find("SYNC-HAZARD-WRITE-AFTER-WRITE"), std::string::npos);
}

TEST(Validation, noticesAWrongUse) {
    gpu::DeviceOptions options;
    options.validation = true;
    gpu::Device device(options);
    const gpu::Buffer buffer(device, 64, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryUse::device, "buffer");
    device.runNow([&](VkCommandBuffer commands) { device.vk.vkCmdFillBuffer(commands, buffer.handle(), 0, 64, 1); });
    EXPECT_EQ(device.validationMessages().size(), 1U);
}

}  // namespace
}  // namespace reflet::test::harness_test
