// A host of the tests' own: plain Vulkan that knows nothing of the program's way to a device. It opens an instance and
// a device with validation, and runs command buffers with three frames in flight.
#pragma once

#include "gpu/context.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace reflet::test {

class Host {
public:
    static constexpr uint32_t framesInFlight = 3;

    Host();
    ~Host();
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    /// As a library is told about the device.
    [[nodiscard]] gpu::OpenDevice device() const;

    /// Waits until the frame three before this one is done, and submits what is recorded.
    void frame(const std::function<void(VkCommandBuffer)>& record);
    void waitForAll();

    [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

private:
    template <class F>
    F instanceFunction(const char* name) const;
    template <class F>
    F deviceFunction(const char* name) const;
    void openInstance();
    void openDevice();
    void makeFrames();
    static VKAPI_ATTR VkBool32 VKAPI_CALL note(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                               VkDebugUtilsMessageTypeFlagsEXT types,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* self);

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::array<VkCommandBuffer, framesInFlight> commands_{};
    std::array<VkFence, framesInFlight> fences_{};
    uint32_t frames_ = 0;
    std::vector<std::string> messages_;
};

}  // namespace reflet::test
