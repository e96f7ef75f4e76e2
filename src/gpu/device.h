// One Vulkan device: chosen, checked against the floor, opened. Owns what all else hangs on.
#pragma once

#include "gpu/memory.h"
#include "gpu/vulkan.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace reflet::gpu {

/// What `reflet list devices` says of one.
struct DeviceDescription {
    std::string name;
    std::string driver;
    std::string kind;                  ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
    std::string api;                   ///< "1.3.230"
    std::vector<std::string> missing;  ///< of the floor; empty: the device can be used
    std::vector<std::string> extras;   ///< beyond the floor: "ray query", "descriptor indexing", …
};

struct DeviceOptions {
    /// An index into the list of devices, or a part of a name (case does not matter). Empty: the best that is there.
    std::string select;
    /// Validation and synchronization validation layers. Their messages go to `onMessage` and are counted.
    bool validation = false;
    std::function<void(const std::string&)> onMessage;
    /// Of the instance, as the window system wants them; where there are any, the device can fill windows.
    std::vector<const char*> windowExtensions;
};

/// All devices the loader knows, usable or not. Empty where there is no loader or no driver.
std::vector<DeviceDescription> listDevices();

/// Fixed ways to sample.
struct SamplerInfo {
    VkFilter mag = VK_FILTER_NEAREST;
    VkFilter min = VK_FILTER_NEAREST;
    VkSamplerMipmapMode mip = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    VkSamplerAddressMode u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSamplerAddressMode v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    float maxLod = VK_LOD_CLAMP_NONE;
    float anisotropy = 1.0F;  ///< samples along a slanted surface, at most; 1: none. Devices may do less, or none

    bool operator==(const SamplerInfo&) const = default;
};

class PipelineCache;

class Device {
public:
    /// Throws Error: no loader, no driver, no such device (naming those there are), or one below the floor (naming
    /// what it lacks).
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const DeviceDescription& description() const { return description_; }
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return limits_; }
    /// Acceleration structures can be built and shaders can query them.
    [[nodiscard]] bool hasRayQuery() const { return rayQuery_; }
    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
    [[nodiscard]] VkDevice handle() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] uint32_t queueFamily() const { return queueFamily_; }
    [[nodiscard]] Memory& memory() { return *memory_; }
    [[nodiscard]] PipelineCache& pipelines() { return *pipelines_; }

    /// The same sampler for the same info, for the device's life.
    VkSampler sampler(const SamplerInfo& info);

    /// Submits; returns the serial by which `wait` and `retire` know the work.
    uint64_t submit(VkCommandBuffer commands);
    /// Returns once all work up to the serial is done. Throws Error when the device is lost.
    void wait(uint64_t serial);

    /// Runs `destroy` once the device has done all that was submitted before, and what is being recorded now.
    void retire(std::function<void()> destroy);

    /// Records and runs commands at once, and waits: for uploads and tests, not for frames.
    void runNow(const std::function<void(VkCommandBuffer)>& record);

    /// Messages of the validation layers so far.
    [[nodiscard]] const std::vector<std::string>& validationMessages() const { return messages_; }

    /// Functions of this device, by volk.
    VolkDeviceTable vk{};

private:
    struct Retired {
        uint64_t serial;
        std::function<void()> destroy;
    };

    void createInstance(const DeviceOptions& options);
    void createDevice(bool fillsWindows);
    void collectRetired();
    static VKAPI_ATTR VkBool32 VKAPI_CALL onValidation(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                       VkDebugUtilsMessageTypeFlagsEXT types,
                                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* self);

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint32_t queueFamily_ = 0;
    VkSemaphore timeline_ = VK_NULL_HANDLE;
    VkCommandPool immediatePool_ = VK_NULL_HANDLE;
    uint64_t submitted_ = 0;
    uint64_t completed_ = 0;
    DeviceDescription description_;
    VkPhysicalDeviceLimits limits_{};
    bool anisotropic_ = false;
    bool rayQuery_ = false;
    std::unique_ptr<Memory> memory_;
    std::unique_ptr<PipelineCache> pipelines_;
    std::vector<std::pair<SamplerInfo, VkSampler>> samplers_;
    std::deque<Retired> retired_;
    std::vector<std::string> messages_;
    std::function<void(const std::string&)> onMessage_;
};

}  // namespace reflet::gpu
