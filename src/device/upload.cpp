// Uploads images and buffers.
#include "device/upload.h"

#include "base/error.h"
#include "device/device.h"
#include "gpu/barrier.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace reflet::gpu {

namespace {

// Generates each level from the previous one; leaves all levels readable by shaders.
void generateMips(Device& device, VkCommandBuffer commands, VkImage image, uvec2 size, uint32_t mips) {
    constexpr VkImageLayout source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkImageLayout target = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    const auto extent = [&](uint32_t mip) {
        return VkOffset3D{static_cast<int32_t>(std::max(size.x >> mip, 1U)),
                          static_cast<int32_t>(std::max(size.y >> mip, 1U)), 1};
    };
    for (uint32_t mip = 1; mip < mips; ++mip) {
        layoutBarrier(device.vk, commands, image, {mip - 1, 1}, target, source);
        VkImageBlit blit{};
        blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip - 1, 0, 1};
        blit.srcOffsets[1] = extent(mip - 1);
        blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip, 0, 1};
        blit.dstOffsets[1] = extent(mip);
        device.vk.vkCmdBlitImage(commands, image, source, image, target, 1, &blit, VK_FILTER_LINEAR);
    }
    layoutBarrier(device.vk, commands, image, {mips - 1, 1}, target, source);
    layoutBarrier(device.vk, commands, image, {0, mips}, source, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

Buffer stagingBuffer(Device& device, std::span<const std::byte> bytes, const std::string& name) {
    Buffer staging(device, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::upload, name);
    std::memcpy(staging.bytes().data(), bytes.data(), bytes.size());
    return staging;
}

}  // namespace

Texture uploadTexels(Device& device, const ImageInfo& info, std::span<const std::byte> texels,
                     const std::string& name) {
    REFLET_CHECK(texels.size() == size_t(info.size.x) * info.size.y * bytesPerTexel(info.format) && info.layers == 1,
                 "'{}': {} bytes for {}x{}", name, texels.size(), info.size.x, info.size.y);
    ImageInfo full = info;
    full.usage |= VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    Texture texture(device, full, name);
    const Buffer staging = stagingBuffer(device, texels, name);
    ImageState& state = *texture.image().state;
    device.runNow([&](VkCommandBuffer commands) {
        layoutBarrier(device.vk, commands, state.image, {0, info.mips}, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {info.size.x, info.size.y, 1};
        device.vk.vkCmdCopyBufferToImage(commands, staging.handle(), state.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                         1, &copy);
        generateMips(device, commands, state.image, info.size, info.mips);
    });
    state.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    return texture;
}

Texture uploadTexture(Device& device, uvec2 size, std::span<const uint8_t> rgba, bool srgb, bool mips,
                      const std::string& name) {
    const uint32_t levels = mips ? static_cast<uint32_t>(std::bit_width(std::max(size.x, size.y))) : 1;
    return uploadTexels(device, {srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM, size, levels},
                        std::as_bytes(rgba), name);
}

Buffer uploadBuffer(Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                    const std::string& name) {
    Buffer buffer(device, bytes.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::device, name);
    const Buffer staging = stagingBuffer(device, bytes, name);
    device.runNow([&](VkCommandBuffer commands) {
        const VkBufferCopy copy{0, 0, bytes.size()};
        device.vk.vkCmdCopyBuffer(commands, staging.handle(), buffer.handle(), 1, &copy);
        VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_TRANSFER_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT;
        VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.memoryBarrierCount = 1;
        info.pMemoryBarriers = &barrier;
        device.vk.vkCmdPipelineBarrier2(commands, &info);
    });
    return buffer;
}

}  // namespace reflet::gpu
