// Looks up the functions of a device.
#include "gpu/functions.h"

#include "base/error.h"

#include <string>

namespace reflet::gpu {

namespace {

// A host may have opened its device with an extension in place of the version that took it up.
PFN_vkVoidFunction find(PFN_vkGetDeviceProcAddr lookUp, VkDevice device, const char* name) {
    if (const PFN_vkVoidFunction found = lookUp(device, name)) {
        return found;
    }
    if (const PFN_vkVoidFunction found = lookUp(device, (std::string(name) + "KHR").c_str())) {
        return found;
    }
    throw Unsupported(
        fmt::format("this device has no {}: its instance was created for a version of Vulkan below 1.3 "
                    "(VkApplicationInfo::apiVersion) and the device without VK_KHR_synchronization2, or a layer or "
                    "driver lacks it",
                    name));
}

}  // namespace

DeviceFunctions loadFunctions(PFN_vkGetDeviceProcAddr lookUp, VkDevice device, bool rayQuery) {
    DeviceFunctions functions;
#define REFLET_LOAD(name) functions.name = reinterpret_cast<PFN_##name>(find(lookUp, device, #name));
    REFLET_DEVICE_FUNCTIONS(REFLET_LOAD)
#define REFLET_FIND(name) functions.name = reinterpret_cast<PFN_##name>(lookUp(device, #name));
    REFLET_RASTER_FUNCTIONS(REFLET_FIND)
#undef REFLET_FIND
    if (rayQuery) {
        REFLET_RAY_QUERY_FUNCTIONS(REFLET_LOAD)
    }
#undef REFLET_LOAD
    return functions;
}

}  // namespace reflet::gpu
