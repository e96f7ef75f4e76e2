// The Vulkan functions that the fault layer makes fail, and the errors that the specification allows for each.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace reflet::fault {

// Instead of the headers of X.
using PFN_vkCreateXcbSurfaceKHR = VkResult(VKAPI_PTR*)(VkInstance, const void*, const VkAllocationCallbacks*,
                                                       VkSurfaceKHR*);
using PFN_vkCreateXlibSurfaceKHR = PFN_vkCreateXcbSurfaceKHR;

// Sets of errors.
#define REFLET_MEMORY VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY
#define REFLET_LOST REFLET_MEMORY, VK_ERROR_DEVICE_LOST
#define REFLET_SURFACE REFLET_MEMORY, VK_ERROR_SURFACE_LOST_KHR
#define REFLET_PRESENT REFLET_LOST, VK_ERROR_SURFACE_LOST_KHR, VK_ERROR_OUT_OF_DATE_KHR, VK_SUBOPTIMAL_KHR

// F(creating function, destroying function, errors): their objects are tracked.
#define REFLET_CREATING(F)                                                                              \
    F(vkAllocateMemory, vkFreeMemory, REFLET_MEMORY)                                                    \
    F(vkCreateAccelerationStructureKHR, vkDestroyAccelerationStructureKHR, VK_ERROR_OUT_OF_HOST_MEMORY) \
    F(vkCreateBuffer, vkDestroyBuffer, REFLET_MEMORY)                                                   \
    F(vkCreateCommandPool, vkDestroyCommandPool, REFLET_MEMORY)                                         \
    F(vkCreateComputePipelines, vkDestroyPipeline, REFLET_MEMORY)                                       \
    F(vkCreateDebugUtilsMessengerEXT, vkDestroyDebugUtilsMessengerEXT, VK_ERROR_OUT_OF_HOST_MEMORY)     \
    F(vkCreateDescriptorPool, vkDestroyDescriptorPool, REFLET_MEMORY, VK_ERROR_FRAGMENTATION)           \
    F(vkCreateDescriptorSetLayout, vkDestroyDescriptorSetLayout, REFLET_MEMORY)                         \
    F(vkCreateFence, vkDestroyFence, REFLET_MEMORY)                                                     \
    F(vkCreateGraphicsPipelines, vkDestroyPipeline, REFLET_MEMORY)                                      \
    F(vkCreateImage, vkDestroyImage, REFLET_MEMORY)                                                     \
    F(vkCreateImageView, vkDestroyImageView, REFLET_MEMORY)                                             \
    F(vkCreatePipelineCache, vkDestroyPipelineCache, REFLET_MEMORY)                                     \
    F(vkCreatePipelineLayout, vkDestroyPipelineLayout, REFLET_MEMORY)                                   \
    F(vkCreateQueryPool, vkDestroyQueryPool, REFLET_MEMORY)                                             \
    F(vkCreateSampler, vkDestroySampler, REFLET_MEMORY)                                                 \
    F(vkCreateSemaphore, vkDestroySemaphore, REFLET_MEMORY)                                             \
    F(vkCreateShaderModule, vkDestroyShaderModule, REFLET_MEMORY)                                       \
    F(vkCreateSwapchainKHR, vkDestroySwapchainKHR, REFLET_LOST, VK_ERROR_SURFACE_LOST_KHR,              \
      VK_ERROR_NATIVE_WINDOW_IN_USE_KHR, VK_ERROR_INITIALIZATION_FAILED)                                \
    F(vkCreateXcbSurfaceKHR, vkDestroySurfaceKHR, REFLET_MEMORY)                                        \
    F(vkCreateXlibSurfaceKHR, vkDestroySurfaceKHR, REFLET_MEMORY)

// F(function, errors)
#define REFLET_OTHER(F)                                                                               \
    F(vkAcquireNextImageKHR, REFLET_PRESENT)                                                          \
    F(vkAllocateCommandBuffers, REFLET_MEMORY)                                                        \
    F(vkAllocateDescriptorSets, REFLET_MEMORY, VK_ERROR_FRAGMENTED_POOL, VK_ERROR_OUT_OF_POOL_MEMORY) \
    F(vkBeginCommandBuffer, REFLET_MEMORY)                                                            \
    F(vkBindBufferMemory, REFLET_MEMORY)                                                              \
    F(vkBindImageMemory, REFLET_MEMORY)                                                               \
    F(vkDeviceWaitIdle, REFLET_LOST)                                                                  \
    F(vkEndCommandBuffer, REFLET_MEMORY)                                                              \
    F(vkEnumerateDeviceExtensionProperties, REFLET_MEMORY)                                            \
    F(vkEnumeratePhysicalDevices, REFLET_MEMORY, VK_ERROR_INITIALIZATION_FAILED)                      \
    F(vkGetPipelineCacheData, REFLET_MEMORY)                                                          \
    F(vkGetPhysicalDeviceSurfaceCapabilitiesKHR, REFLET_SURFACE)                                      \
    F(vkGetPhysicalDeviceSurfaceFormatsKHR, REFLET_SURFACE)                                           \
    F(vkGetPhysicalDeviceSurfaceSupportKHR, REFLET_SURFACE)                                           \
    F(vkGetQueryPoolResults, REFLET_LOST)                                                             \
    F(vkGetSwapchainImagesKHR, REFLET_MEMORY)                                                         \
    F(vkMapMemory, REFLET_MEMORY, VK_ERROR_MEMORY_MAP_FAILED)                                         \
    F(vkQueuePresentKHR, REFLET_PRESENT)                                                              \
    F(vkQueueSubmit, REFLET_LOST)                                                                     \
    F(vkQueueSubmit2, REFLET_LOST)                                                                    \
    F(vkResetCommandPool, VK_ERROR_OUT_OF_DEVICE_MEMORY)                                              \
    F(vkResetFences, VK_ERROR_OUT_OF_DEVICE_MEMORY)                                                   \
    F(vkSetDebugUtilsObjectNameEXT, REFLET_MEMORY)                                                    \
    F(vkWaitForFences, REFLET_LOST)                                                                   \
    F(vkWaitSemaphores, REFLET_LOST)

// Those that make and end the layer's own chains.
#define REFLET_OWN(F)                                                                                \
    F(vkCreateInstance, REFLET_MEMORY, VK_ERROR_INITIALIZATION_FAILED, VK_ERROR_INCOMPATIBLE_DRIVER) \
    F(vkCreateDevice, REFLET_LOST, VK_ERROR_INITIALIZATION_FAILED, VK_ERROR_TOO_MANY_OBJECTS)

enum Function : uint8_t {
#define REFLET_ENUMERATOR(name, ...) f_##name,
    REFLET_CREATING(REFLET_ENUMERATOR) REFLET_OTHER(REFLET_ENUMERATOR) REFLET_OWN(REFLET_ENUMERATOR)
#undef REFLET_ENUMERATOR
        functionCount
};

struct FunctionInfo {
    const char* name;
    std::array<VkResult, 7> errors;  ///< those of its own, then VK_SUCCESS

    [[nodiscard]] bool mayReturn(VkResult result) const {
        for (const VkResult error : errors) {
            if (error == result && error != VK_SUCCESS) {
                return true;
            }
        }
        return false;
    }
};

constexpr std::array<FunctionInfo, functionCount> functions{{
#define REFLET_CREATING_INFO(name, destroying, ...) {#name, {__VA_ARGS__}},
#define REFLET_INFO(name, ...) {#name, {__VA_ARGS__}},
    REFLET_CREATING(REFLET_CREATING_INFO) REFLET_OTHER(REFLET_INFO) REFLET_OWN(REFLET_INFO)
#undef REFLET_CREATING_INFO
#undef REFLET_INFO
}};

struct ResultName {
    VkResult result;
    const char* name;
};

constexpr ResultName resultNames[] = {
#define REFLET_RESULT(name) {name, #name},
    REFLET_RESULT(VK_ERROR_OUT_OF_HOST_MEMORY) REFLET_RESULT(VK_ERROR_OUT_OF_DEVICE_MEMORY)
        REFLET_RESULT(VK_ERROR_DEVICE_LOST) REFLET_RESULT(VK_ERROR_SURFACE_LOST_KHR)
            REFLET_RESULT(VK_ERROR_OUT_OF_DATE_KHR) REFLET_RESULT(VK_SUBOPTIMAL_KHR)
                REFLET_RESULT(VK_ERROR_FRAGMENTATION) REFLET_RESULT(VK_ERROR_FRAGMENTED_POOL)
                    REFLET_RESULT(VK_ERROR_OUT_OF_POOL_MEMORY) REFLET_RESULT(VK_ERROR_MEMORY_MAP_FAILED)
                        REFLET_RESULT(VK_ERROR_INITIALIZATION_FAILED) REFLET_RESULT(VK_ERROR_INCOMPATIBLE_DRIVER)
                            REFLET_RESULT(VK_ERROR_TOO_MANY_OBJECTS) REFLET_RESULT(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR)
#undef REFLET_RESULT
};

}  // namespace reflet::fault
