// Vulkan through volk, and the check of its results.
#pragma once

#include <volk.h>

#include <string>

namespace reflet::gpu {

/// Throws Error: what was tried, and what the device answered.
void vkCheck(VkResult result, const char* what);

std::string resultName(VkResult result);

}  // namespace reflet::gpu
