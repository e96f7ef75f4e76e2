// The program's device: selected, checked against the minimum requirements and opened. Passes use only its base class,
// Context.
#pragma once

#include "device/pipeline_file.h"
#include "gpu/context.h"

#include <volk.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
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
    /// Shaders that passes on this device use.
    std::vector<std::span<const Shader>> shaders;
    /// Instance extensions that the window system needs; if there are any, the device can present to windows.
    std::vector<const char*> windowExtensions;
    /// Where the driver's pipeline cache is kept from run to run; empty: nowhere. For one device of a program.
    std::filesystem::path pipelineFolder;
    /// See PipelineMaking.
    std::function<void(uint32_t shaders)> onCompile;
};

/// All devices that the loader finds, usable or not. Empty without a loader or a driver.
std::vector<DeviceDescription> listDevices();

/// The Vulkan objects of an open device; nothing of it is used by passes.
class DeviceHandles {
public:
    DeviceHandles(const DeviceHandles&) = delete;
    DeviceHandles& operator=(const DeviceHandles&) = delete;

    [[nodiscard]] const DeviceDescription& description() const { return description_; }
    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] uint32_t queueFamily() const { return queueFamily_; }
    /// Functions of the device for queues and windows, loaded by volk.
    [[nodiscard]] const VolkDeviceTable& functions() const { return functions_; }

    /// Messages of the validation layer so far.
    [[nodiscard]] const std::vector<std::string>& validationMessages() const { return messages_; }

protected:
    explicit DeviceHandles(const DeviceOptions& options);
    ~DeviceHandles();
    [[nodiscard]] const OpenDevice& opened() const { return opened_; }

private:
    explicit DeviceHandles(std::function<void(const std::string&)> onMessage);
    void createInstance(const DeviceOptions& options);
    void createDevice(bool fillsWindows);
    void keepPipelines(const DeviceOptions& options);
    static VKAPI_ATTR VkBool32 VKAPI_CALL onValidation(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                       VkDebugUtilsMessageTypeFlagsEXT types,
                                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* self);

    OpenDevice opened_;
    std::optional<KeptPipelines> pipelines_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint32_t queueFamily_ = 0;
    VolkDeviceTable functions_{};
    DeviceDescription description_;
    std::vector<std::string> messages_;
    std::function<void(const std::string&)> onMessage_;
};

/// A device that the program opened: the context of all recording on it, with a queue to submit to.
class Device : public DeviceHandles, public Context {
public:
    /// Throws Error: no loader, no driver, no matching device (lists the available ones), or one that lacks minimum
    /// requirements (lists them).
    explicit Device(const DeviceOptions& options = {});
    ~Device();

    /// Submits; returns the serial number of the submission, for `wait`.
    uint64_t submit(VkCommandBuffer commands);
    /// Blocks until all work up to the serial is done. Throws Error if the device is lost.
    void wait(uint64_t serial);

    /// Records and runs commands immediately, and blocks: for uploads and tests, not for frames.
    void runNow(const std::function<void(VkCommandBuffer)>& record);

private:
    void destroyOwn();
    void recordAndRun(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record);

    VkSemaphore timeline_ = VK_NULL_HANDLE;
    VkCommandPool immediatePool_ = VK_NULL_HANDLE;
    uint64_t submitted_ = 0;
};

}  // namespace reflet::gpu
