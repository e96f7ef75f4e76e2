// Turns stated uses into barriers. All that the frame owns stays in one layout (GENERAL), so that after an image's
// first use everything is a memory barrier.
#pragma once

#include "gpu/pass.h"
#include "gpu/resource.h"

#include <vector>

namespace reflet::gpu {

/// Two uses by one pass as one.
Access merged(const Access& a, const Access& b);

struct MipRange {
    uint32_t first = 0;
    uint32_t count = VK_REMAINING_MIP_LEVELS;
};

/// Between two copies or blits of a colour image, all layers; and, where the layouts differ, from one to the other.
void layoutBarrier(const VolkDeviceTable& vk, VkCommandBuffer commands, VkImage image, const MipRange& mips,
                   VkImageLayout from, VkImageLayout to);

/// The barriers before one pass.
class BarrierBatch {
public:
    void use(ImageState& image, VkImageAspectFlags aspect, const Access& access);
    void use(AccessState& state, const Access& access);
    void record(const VolkDeviceTable& vk, VkCommandBuffer commands) const;

private:
    VkMemoryBarrier2 memory_{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    std::vector<VkImageMemoryBarrier2> first_;  ///< images on their way from UNDEFINED to GENERAL
};

}  // namespace reflet::gpu
