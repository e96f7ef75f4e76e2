// Finds and judges Vulkan devices: which there are, what they lack of the floor, which one is meant.
#pragma once

#include "gpu/device.h"

#include <array>
#include <optional>
#include <span>
#include <string>

namespace reflet::gpu {

/// The features every device must have, as a chain for vkCreateDevice or vkGetPhysicalDeviceFeatures2.
struct FloorFeatures {
    VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};

    void* chain() {
        core.pNext = &v12;
        v12.pNext = &v13;
        return &core;
    }
};
FloorFeatures floorFeatures();

/// What VK_KHR_ray_query takes, as a chain. Shader addresses of buffers (FloorFeatures::v12) belong to it, too.
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

/// Throws Error when there is no loader, or when the layer (may be nullptr) is not installed.
VkInstance makeInstance(const char* layer, std::span<const char* const> extensions = {});

/// Throws Error: a device that cannot fill windows.
void requireSwapchain(VkPhysicalDevice device);

DeviceDescription describe(VkPhysicalDevice device);
std::optional<uint32_t> graphicsQueueFamily(VkPhysicalDevice device);

/// `select` as in DeviceOptions. Throws Error: none, no such, or not up to the floor.
VkPhysicalDevice choosePhysicalDevice(VkInstance instance, const std::string& select);

}  // namespace reflet::gpu
