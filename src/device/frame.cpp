// Submits the passes of a frame and waits for them.
#include "device/frame.h"

#include "base/error.h"
#include "device/device.h"

#include <utility>

namespace reflet::gpu {

Frame::Frame(Device& device) : Recorder(device), device_(device) {
    const VolkDeviceTable& vk = device.functions();
    const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, device.queueFamily()};
    VkCommandPool made = VK_NULL_HANDLE;
    vkCheck(vk.vkCreateCommandPool(device.handle(), &pool, nullptr, &made), "creating a command pool");
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = made;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    const VkResult allocated = vk.vkAllocateCommandBuffers(device.handle(), &allocate, &commands_);
    if (allocated != VK_SUCCESS) {
        vk.vkDestroyCommandPool(device.handle(), made, nullptr);
        vkCheck(allocated, "allocating commands");
    }
    commandPool_ = made;
}

Frame::~Frame() {
    device_.functions().vkDeviceWaitIdle(device_.handle());
    device_.functions().vkDestroyCommandPool(device_.handle(), commandPool_, nullptr);
}

void Frame::beginCommands() {
    const VolkDeviceTable& vk = device_.functions();
    vkCheck(vk.vkResetCommandPool(device_.handle(), commandPool_, 0), "resetting commands");
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    vkCheck(vk.vkBeginCommandBuffer(commands_, &info), "beginning commands");
}

void Frame::begin() {
    device_.wait(serial_);
    betweenPasses({});  // of a frame that was stopped
    submittedPasses_ = false;
    beginCommands();
    Recorder::begin(commands_);
}

void Frame::runPassByPass(std::function<bool()> stop) {
    flush();
    betweenPasses([this, stop = std::move(stop)] { runCommands(stop); });
}

void Frame::runCommands(const std::function<bool()>& stop) {
    vkCheck(device_.functions().vkEndCommandBuffer(commands_), "ending commands");
    if (!submittedPasses_) {
        submitted_ = std::chrono::steady_clock::now();
        submittedPasses_ = true;
    }
    serial_ = device_.submit(commands_);
    device_.wait(serial_);
    beginCommands();
    if (stop()) {
        device_.pipelines().noteUsed();
        throw FrameStopped();
    }
}

void Frame::submit() {
    end();
    betweenPasses({});
    vkCheck(device_.functions().vkEndCommandBuffer(commands_), "ending commands");
    if (!submittedPasses_) {
        submitted_ = std::chrono::steady_clock::now();
    }
    serial_ = device_.submit(commands_);
}

void Frame::wait() {
    device_.wait(serial_);
    submittedMs_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - submitted_).count();
    finish();
    device_.pipelines().noteUsed();
}

}  // namespace reflet::gpu
