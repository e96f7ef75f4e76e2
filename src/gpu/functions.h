// Vulkan functions of one device, in separate tables: two devices, or two libraries in one process, do not share
// pointers, and nothing named vk* is exported.
#pragma once

#include "gpu/vulkan.h"

namespace reflet::gpu {

// Functions of Vulkan 1.2 and synchronization2, without ray tracing. Each is looked up by its name, then with the
// suffix KHR.
#define REFLET_DEVICE_FUNCTIONS(F)   \
    F(vkAllocateDescriptorSets)      \
    F(vkAllocateMemory)              \
    F(vkBindBufferMemory)            \
    F(vkBindImageMemory)             \
    F(vkCmdBindDescriptorSets)       \
    F(vkCmdBindIndexBuffer)          \
    F(vkCmdBindPipeline)             \
    F(vkCmdBindVertexBuffers)        \
    F(vkCmdBlitImage)                \
    F(vkCmdClearColorImage)          \
    F(vkCmdCopyBuffer)               \
    F(vkCmdCopyBufferToImage)        \
    F(vkCmdCopyImage)                \
    F(vkCmdCopyImageToBuffer)        \
    F(vkCmdDispatch)                 \
    F(vkCmdDispatchIndirect)         \
    F(vkCmdDrawIndexed)              \
    F(vkCmdFillBuffer)               \
    F(vkCmdPipelineBarrier2)         \
    F(vkCmdPushConstants)            \
    F(vkCmdResetQueryPool)           \
    F(vkCmdSetScissor)               \
    F(vkCmdSetViewport)              \
    F(vkCmdUpdateBuffer)             \
    F(vkCmdWriteTimestamp2)          \
    F(vkCreateBuffer)                \
    F(vkCreateComputePipelines)      \
    F(vkCreateDescriptorPool)        \
    F(vkCreateDescriptorSetLayout)   \
    F(vkCreateGraphicsPipelines)     \
    F(vkCreateImage)                 \
    F(vkCreateImageView)             \
    F(vkCreatePipelineLayout)        \
    F(vkCreateQueryPool)             \
    F(vkCreateSampler)               \
    F(vkCreatePipelineCache)         \
    F(vkDestroyPipelineCache)        \
    F(vkGetPipelineCacheData)        \
    F(vkCreateShaderModule)          \
    F(vkDestroyBuffer)               \
    F(vkDestroyDescriptorPool)       \
    F(vkDestroyDescriptorSetLayout)  \
    F(vkDestroyImage)                \
    F(vkDestroyImageView)            \
    F(vkDestroyPipeline)             \
    F(vkDestroyPipelineLayout)       \
    F(vkDestroyQueryPool)            \
    F(vkDestroySampler)              \
    F(vkDestroyShaderModule)         \
    F(vkFreeDescriptorSets)          \
    F(vkFreeMemory)                  \
    F(vkGetBufferMemoryRequirements) \
    F(vkGetImageMemoryRequirements)  \
    F(vkGetQueryPoolResults)         \
    F(vkMapMemory)                   \
    F(vkUpdateDescriptorSets)

// Functions of Vulkan 1.3 for raster passes: null where a device lacks them, as effects draw nothing.
#define REFLET_RASTER_FUNCTIONS(F) \
    F(vkCmdBeginRendering)         \
    F(vkCmdEndRendering)           \
    F(vkCmdSetCullMode)            \
    F(vkCmdSetFrontFace)

// Functions of VK_KHR_acceleration_structure, and the buffer device addresses that it needs.
#define REFLET_RAY_QUERY_FUNCTIONS(F)             \
    F(vkCmdBuildAccelerationStructuresKHR)        \
    F(vkCreateAccelerationStructureKHR)           \
    F(vkDestroyAccelerationStructureKHR)          \
    F(vkGetAccelerationStructureBuildSizesKHR)    \
    F(vkGetAccelerationStructureDeviceAddressKHR) \
    F(vkGetBufferDeviceAddress)

struct DeviceFunctions {
#define REFLET_MEMBER(name) PFN_##name name = nullptr;
    REFLET_DEVICE_FUNCTIONS(REFLET_MEMBER)
    REFLET_RASTER_FUNCTIONS(REFLET_MEMBER)
    REFLET_RAY_QUERY_FUNCTIONS(REFLET_MEMBER)
#undef REFLET_MEMBER
};

/// Loads the functions; those for acceleration structures stay null without `rayQuery`. Throws Error that names the
/// first missing function.
DeviceFunctions loadFunctions(PFN_vkGetDeviceProcAddr lookUp, VkDevice device, bool rayQuery);

}  // namespace reflet::gpu
