// Lists Vulkan devices, checks them against the minimum requirements and selects one.
#pragma once

#include "device/device.h"

#include <array>
#include <optional>
#include <span>
#include <string>

namespace reflet::gpu {

/// The features that every device must have, as a chain for vkCreateDevice or vkGetPhysicalDeviceFeatures2.
struct RequiredFeatures {
    VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};

    void* chain() {
        core.pNext = &v12;
        v12.pNext = &v13;
        return &core;
    }
};
RequiredFeatures requiredFeatures();

/// The features that ray query needs, as a chain. Buffer device addresses (RequiredFeatures::v12) are also needed.
struct RayQueryFeatures {
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    VkPhysicalDeviceRayQueryFeaturesKHR query{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};

    void* chain() {
        structures.pNext = &query;
        return &structures;
    }
};
inline constexpr std::array rayQueryExtensions{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                               VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
                                               VK_KHR_RAY_QUERY_EXTENSION_NAME};
bool hasRayQuery(VkPhysicalDevice device);

/// Throws Error if there is no loader, or the layer (may be nullptr) is not installed.
VkInstance makeInstance(const char* layer, std::span<const char* const> extensions = {});

/// Throws Error if the device cannot present to windows.
void requireSwapchain(VkPhysicalDevice device);

DeviceDescription describe(VkPhysicalDevice device);
std::optional<uint32_t> graphicsQueueFamily(VkPhysicalDevice device);

/// `select`: as in DeviceOptions. Throws Error: no device, no match, or missing requirements.
VkPhysicalDevice choosePhysicalDevice(VkInstance instance, const std::string& select);

}  // namespace reflet::gpu
