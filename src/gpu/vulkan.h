// Vulkan without prototypes (functions are called through tables, see functions.h), and result checks.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#include <string>

namespace reflet::gpu {

/// Throws Error "WHAT failed: RESULT".
void vkCheck(VkResult result, const char* what);

std::string resultName(VkResult result);

}  // namespace reflet::gpu
