// Derives barriers from declared uses. All images of the frame stay in one layout (GENERAL), so after the first use of
// an image every barrier is a memory barrier.
#pragma once

#include "gpu/functions.h"
#include "gpu/pass.h"
#include "gpu/resource.h"

#include <vector>

namespace reflet::gpu {

/// Merges two uses by one pass.
Access merged(const Access& a, const Access& b);

struct MipRange {
    uint32_t first = 0;
    uint32_t count = VK_REMAINING_MIP_LEVELS;
};

/// Barrier between two copies or blits of a colour image, all layers; changes the layout if `from` and `to` differ.
void layoutBarrier(const DeviceFunctions& vk, VkCommandBuffer commands, VkImage image, const MipRange& mips,
                   VkImageLayout from, VkImageLayout to);

/// Collects the barriers before one pass.
class BarrierBatch {
public:
    void use(ImageState& image, VkImageAspectFlags aspect, const Access& access);
    void use(AccessState& state, const Access& access);
    void record(const DeviceFunctions& vk, VkCommandBuffer commands) const;

private:
    VkMemoryBarrier2 memory_{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    std::vector<VkImageMemoryBarrier2> first_;  ///< transitions from UNDEFINED to GENERAL
};

}  // namespace reflet::gpu
