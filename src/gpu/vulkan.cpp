// Names of results.
#include "gpu/vulkan.h"

namespace reflet::gpu {

void vkCheck(VkResult result, const char* what) {
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
        throw OutOfMemory(fmt::format("{} failed: {}", what, resultName(result)));
    }
    if (result < 0) {
        fail("{} failed: {}", what, resultName(result));
    }
}

std::string resultName(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "out of host memory";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "out of device memory";
        case VK_ERROR_DEVICE_LOST:
            return "the device was lost";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "initialization failed";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "a layer is not installed";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "no driver fits";
        default:
            return fmt::format("VkResult {}", static_cast<int>(result));
    }
}

}  // namespace reflet::gpu
