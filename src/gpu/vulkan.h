// Vulkan without prototypes (functions are called through tables, see functions.h), and result checks.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#include "base/error.h"

#include <string>

namespace reflet::gpu {

/// Device or host memory is exhausted.
class OutOfMemory : public Error {
public:
    using Error::Error;
};

/// The device lacks a required feature, or the feature was not enabled.
class Unsupported : public Error {
public:
    using Error::Error;
};

/// Throws Error "WHAT failed: RESULT", or OutOfMemory.
void vkCheck(VkResult result, const char* what);

std::string resultName(VkResult result);

}  // namespace reflet::gpu
