// Barriers between copies and blits outside of frames.
#pragma once

#include "gpu/functions.h"

namespace reflet::gpu {

struct MipRange {
    uint32_t first = 0;
    uint32_t count = VK_REMAINING_MIP_LEVELS;
};

/// Barrier between two copies or blits of a colour image, all layers; changes the layout if `from` and `to` differ.
void layoutBarrier(const DeviceFunctions& vk, VkCommandBuffer commands, VkImage image, const MipRange& mips,
                   VkImageLayout from, VkImageLayout to);

}  // namespace reflet::gpu
