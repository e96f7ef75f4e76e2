// One Vulkan device: selected, checked against the minimum requirements and opened. Owns what everything else on the
// device depends on.
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

/// What `reflet list devices` prints about a device.
struct DeviceDescription {
    std::string name;
    std::string driver;
    std::string kind;                  ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
    std::string api;                   ///< "1.3.230"
    std::vector<std::string> missing;  ///< missing minimum requirements; empty: usable
    std::vector<std::string> extras;   ///< optional features: "ray query", "descriptor indexing", …
};

struct DeviceOptions {
    /// Index into the list of devices, or part of a name (case-insensitive). Empty: the best usable device.
    std::string select;
    /// Enables the validation layer with synchronization validation. Its messages go to `onMessage` and are recorded.
    bool validation = false;
    std::function<void(const std::string&)> onMessage;
    /// Instance extensions that the window system needs; if there are any, the device can present to windows.
    std::vector<const char*> windowExtensions;
};

/// All devices that the loader finds, usable or not. Empty without a loader or a driver.
std::vector<DeviceDescription> listDevices();

/// Parameters of a sampler.
struct SamplerInfo {
    VkFilter mag = VK_FILTER_NEAREST;
    VkFilter min = VK_FILTER_NEAREST;
    VkSamplerMipmapMode mip = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    VkSamplerAddressMode u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSamplerAddressMode v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    float maxLod = VK_LOD_CLAMP_NONE;
    float anisotropy = 1.0F;  ///< maximum anisotropy; 1: off. Clamped to what the device supports
    float lodBias = 0.0F;     ///< added to the mip level. Clamped to what the device supports

    bool operator==(const SamplerInfo&) const = default;
};

class PipelineCache;

class Device {
public:
    /// Throws Error: no loader, no driver, no matching device (lists the available ones), or one that lacks minimum
    /// requirements (lists them).
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const DeviceDescription& description() const { return description_; }
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return limits_; }
    /// Whether acceleration structures can be built and queried by shaders.
    [[nodiscard]] bool hasRayQuery() const { return rayQuery_; }
    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
    [[nodiscard]] VkDevice handle() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] uint32_t queueFamily() const { return queueFamily_; }
    [[nodiscard]] Memory& memory() { return *memory_; }
    [[nodiscard]] PipelineCache& pipelines() { return *pipelines_; }

    /// Equal infos share one sampler, which lives as long as the device.
    VkSampler sampler(const SamplerInfo& info);

    /// Submits; returns the serial number of the work, for `wait`.
    uint64_t submit(VkCommandBuffer commands);
    /// Blocks until all work up to the serial is done. Throws Error if the device is lost.
    void wait(uint64_t serial);

    /// Deferred destruction: runs `destroy` once the device has finished everything submitted so far, and the commands
    /// being recorded now.
    void retire(std::function<void()> destroy);

    /// Records and runs commands immediately, and blocks: for uploads and tests, not for frames.
    void runNow(const std::function<void(VkCommandBuffer)>& record);

    /// Messages of the validation layer so far.
    [[nodiscard]] const std::vector<std::string>& validationMessages() const { return messages_; }

    /// Device-level functions, loaded by volk.
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
