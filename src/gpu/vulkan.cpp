// Names of results, and what to do about them.
#include "gpu/vulkan.h"

namespace reflet::gpu {

namespace {

bool isMemory(VkResult result) {
    return result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY ||
           result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL ||
           result == VK_ERROR_FRAGMENTATION || result == VK_ERROR_MEMORY_MAP_FAILED;
}

const char* advice(VkResult result) {
    if (isMemory(result)) {
        return result == VK_ERROR_OUT_OF_HOST_MEMORY ? "; close other programs or render at a smaller size"
                                                     : "; close other programs that use it or render at a smaller size";
    }
    switch (result) {
        case VK_ERROR_DEVICE_LOST:
            return "; the driver has reset it: start again, and update the driver if this repeats";
        case VK_ERROR_SURFACE_LOST_KHR:
            return "; open the window again";
        case VK_ERROR_UNKNOWN:
            return "; if it runs on the CPU, threads may have run out: raise the limit of processes (ulimit -u), or "
                   "end "
                   "others";
        default:
            return "";
    }
}

}  // namespace

void vkCheck(VkResult result, const char* what) {
    if (result >= 0) {
        return;
    }
    const std::string text = fmt::format("{} failed: {}{}", what, resultName(result), advice(result));
    if (isMemory(result)) {
        throw OutOfMemory(text);
    }
    throw Error(text);
}

std::string resultName(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "out of host memory";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "out of device memory";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
        case VK_ERROR_FRAGMENTED_POOL:
        case VK_ERROR_FRAGMENTATION:
            return "out of memory for descriptors";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "out of addresses for device memory";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "too many devices are open";
        case VK_ERROR_DEVICE_LOST:
            return "the device was lost";
        case VK_ERROR_SURFACE_LOST_KHR:
            return "the window's surface was lost";
        case VK_ERROR_NATIVE_WINDOW_IN_USE_KHR:
            return "the window is in use by something else";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "initialization failed";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "a layer is not installed";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "no driver fits";
        case VK_ERROR_UNKNOWN:
            return "the driver does not say why";
        default:
            return fmt::format("VkResult {}", static_cast<int>(result));
    }
}

}  // namespace reflet::gpu
