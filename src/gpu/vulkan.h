// Vulkan, loaded by volk, and result checks.
#pragma once

#include <volk.h>

#include <string>

namespace reflet::gpu {

/// Throws Error "WHAT failed: RESULT".
void vkCheck(VkResult result, const char* what);

std::string resultName(VkResult result);

}  // namespace reflet::gpu
