// A GPU that is not there: Mesa's driver for AMD GPUs (RADV) has a null device, whose compiler is the real one.
#pragma once

#include "gpu/context.h"

#include "reflet/reflet.h"

#include <string>

namespace reflet::gpu_compilers {

/// NAVI21 (RX 6800 XT) by RADV's null device.
class NullDevice {
public:
    /// nullptr: the machine has no such driver. Lives as long as the process.
    static const NullDevice* get();

    /// Its pointers are valid as long as the device.
    [[nodiscard]] RefletContextInfo contextInfo() const;
    [[nodiscard]] gpu::OpenDevice open() const {
        return {instance_, physical_, device_, contextInfo().getInstanceProcAddr};
    }
    /// "radv Mesa 22.3.6".
    [[nodiscard]] const std::string& driver() const { return driver_; }

private:
    NullDevice() = default;
    bool create();

    std::string driver_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkPhysicalDeviceFeatures2 features_{};
    VkPhysicalDeviceVulkan12Features v12_{};
    VkPhysicalDeviceVulkan13Features v13_{};
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics_{};
};

}  // namespace reflet::gpu_compilers
