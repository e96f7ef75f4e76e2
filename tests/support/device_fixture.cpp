// One Vulkan device for all tests of a process.
#include "support/device_fixture.h"

#include "renderer/shaders.h"

#include <memory>
#include <string>
#include <vector>

namespace reflet::test {

namespace {

struct Shared {
    std::unique_ptr<gpu::Device> device;
    std::unique_ptr<gpu::Frame> frame;
    std::vector<std::string> messages;  ///< outlives the device, to catch messages of its destruction
};

Shared& shared() {
    static Shared instance;
    return instance;
}

class DeviceEnd : public ::testing::Environment {
public:
    void TearDown() override {
        const size_t before = shared().messages.size();
        shared().frame.reset();
        shared().device.reset();
        for (size_t i = before; i < shared().messages.size(); ++i) {
            ADD_FAILURE() << "validation, at destruction of the device: " << shared().messages[i];
        }
    }
};

const ::testing::Environment* const deviceEnd = ::testing::AddGlobalTestEnvironment(new DeviceEnd);

}  // namespace

gpu::Device& DeviceTest::device() {
    if (!shared().device) {
        gpu::DeviceOptions options;
        options.validation = true;
        options.shaders = {effectShaders(), rendererShaders()};
        options.onMessage = [](const std::string& message) { shared().messages.push_back(message); };
        shared().device = std::make_unique<gpu::Device>(options);
    }
    return *shared().device;
}

gpu::Frame& DeviceTest::frame() {
    if (!shared().frame) {
        shared().frame = std::make_unique<gpu::Frame>(device());
    }
    return *shared().frame;
}

void DeviceTest::showToHost() {
    device().runNow([&](VkCommandBuffer commands) {
        VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
        VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.memoryBarrierCount = 1;
        info.pMemoryBarriers = &barrier;
        device().vk.vkCmdPipelineBarrier2(commands, &info);
    });
}

void DeviceTest::SetUp() {
    messagesBefore_ = shared().messages.size();
}

void DeviceTest::TearDown() {
    for (size_t i = messagesBefore_; i < shared().messages.size(); ++i) {
        ADD_FAILURE() << "validation: " << shared().messages[i];
    }
}

}  // namespace reflet::test
