// Opens RADV's null device.
#include "gpu_compilers/null_device.h"

#include "gpu_compilers/recorder.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include <volk.h>

namespace reflet::gpu_compilers {

namespace {

constexpr std::array instanceExtensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
constexpr std::array deviceExtensions{VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME};

}  // namespace

const NullDevice* NullDevice::get() {
    static NullDevice device;
    static const bool opened = device.create();
    return opened ? &device : nullptr;
}

bool NullDevice::create() {
    const char* manifest = "/usr/share/vulkan/icd.d/radeon_icd.x86_64.json";
    if (!std::filesystem::exists(manifest)) {
        return false;
    }
    // NOLINTBEGIN(concurrency-mt-unsafe): before there are threads
    ::setenv("VK_DRIVER_FILES", manifest, 1);
    ::setenv("VK_ICD_FILENAMES", manifest, 1);
    ::setenv("RADV_FORCE_FAMILY", "navi21", 1);
    // NOLINTEND(concurrency-mt-unsafe)
    if (volkInitialize() != VK_SUCCESS) {
        return false;
    }
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instanceInfo.pApplicationInfo = &application;
    instanceInfo.enabledExtensionCount = instanceExtensions.size();
    instanceInfo.ppEnabledExtensionNames = instanceExtensions.data();
    if (vkCreateInstance(&instanceInfo, nullptr, &instance_) != VK_SUCCESS) {
        return false;
    }
    volkLoadInstance(instance_);
    uint32_t count = 1;
    if (vkEnumeratePhysicalDevices(instance_, &count, &physical_) < VK_SUCCESS || count == 0) {
        return false;
    }
    VkPhysicalDeviceVulkan12Properties properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &properties};
    vkGetPhysicalDeviceProperties2(physical_, &all);
    if (std::string_view(all.properties.deviceName).find("NAVI21") == std::string_view::npos) {
        return false;  // a real device
    }
    driver_ = std::string(properties.driverName) + " " + properties.driverInfo;
    statistics_ = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR};
    statistics_.pipelineExecutableInfo = VK_TRUE;
    v13_ = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, &statistics_};
    v13_.synchronization2 = VK_TRUE;
    v13_.maintenance4 = VK_TRUE;
    v12_ = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v13_};
    v12_.scalarBlockLayout = VK_TRUE;
    features_ = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v12_};
    features_.features.shaderStorageImageExtendedFormats = VK_TRUE;
    features_.features.imageCubeArray = VK_TRUE;
    features_.features.samplerAnisotropy = VK_TRUE;
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features_};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = deviceExtensions.size();
    info.ppEnabledExtensionNames = deviceExtensions.data();
    return vkCreateDevice(physical_, &info, nullptr, &device_) == VK_SUCCESS;
}

RefletContextInfo NullDevice::contextInfo() const {
    RefletContextInfo info{};
    info.structSize = sizeof info;
    info.version = REFLET_VERSION;
    info.instance = instance_;
    info.physicalDevice = physical_;
    info.device = device_;
    info.getInstanceProcAddr = lookUpRecorded;
    info.enabledFeatures = &features_;
    info.enabledExtensions = instanceExtensions.data();
    info.enabledExtensionCount = instanceExtensions.size();
    return info;
}

}  // namespace reflet::gpu_compilers
