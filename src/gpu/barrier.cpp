// Derives barriers from declared uses.
#include "gpu/barrier.h"

namespace reflet::gpu {

namespace {

constexpr VkAccessFlags2 writeAccess = VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                       VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;

}  // namespace

Access merged(const Access& a, const Access& b) {
    return {a.stages | b.stages, a.access | b.access, a.write || b.write};
}

void BarrierBatch::use(AccessState& state, const Access& access) {
    const bool seen = (state.visibleStages & access.stages) == access.stages &&
                      (state.visibleAccess & access.access) == access.access;
    if (state.writeStages != 0 && (access.write || !seen)) {  // after a write: execution and visibility
        memory_.srcStageMask |= state.writeStages;
        memory_.srcAccessMask |= state.writeAccess;
        memory_.dstStageMask |= access.stages;
        memory_.dstAccessMask |= access.access;
    }
    if (!access.write) {
        state.visibleStages |= access.stages;
        state.visibleAccess |= access.access;
        state.readStages |= access.stages;
        return;
    }
    if (state.readStages != 0) {  // write after read: execution only
        memory_.srcStageMask |= state.readStages;
        memory_.dstStageMask |= access.stages;
        memory_.dstAccessMask |= access.access;
    }
    state = {access.stages, access.access & writeAccess, 0, 0, 0};
}

void BarrierBatch::use(ImageState& image, VkImageAspectFlags aspect, const Access& access) {
    if (image.external || image.layout == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
        return;  // uploaded once, read-only from then on
    }
    if (image.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
        VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        barrier.dstStageMask = access.stages;
        barrier.dstAccessMask = access.access;
        barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.image = image.image;
        barrier.subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
        first_.push_back(barrier);
        image.layout = VK_IMAGE_LAYOUT_GENERAL;
        if (!access.write) {  // the transition counts as a write visible to this stage
            image.access = {access.stages, 0, access.stages, access.stages, access.access};
            return;
        }
    }
    use(image.access, access);
}

void BarrierBatch::record(const DeviceFunctions& vk, VkCommandBuffer commands) const {
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = memory_.srcStageMask != 0 ? 1 : 0;
    info.pMemoryBarriers = &memory_;
    info.imageMemoryBarrierCount = static_cast<uint32_t>(first_.size());
    info.pImageMemoryBarriers = first_.data();
    if (info.memoryBarrierCount + info.imageMemoryBarrierCount > 0) {
        vk.vkCmdPipelineBarrier2(commands, &info);
    }
}

void layoutBarrier(const DeviceFunctions& vk, VkCommandBuffer commands, VkImage image, const MipRange& mips,
                   VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, mips.first, mips.count, 0, VK_REMAINING_ARRAY_LAYERS};
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vk.vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace reflet::gpu
