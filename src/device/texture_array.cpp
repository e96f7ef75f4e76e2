// Uploads images one by one and copies them into the array on the device.
#include "device/texture_array.h"

#include "base/error.h"
#include "device/device.h"
#include "gpu/barrier.h"

#include <algorithm>
#include <bit>

namespace reflet::gpu {

namespace {

uvec2 levelExtent(uvec2 size, uint32_t level) {
    return max(size >> level, uvec2(1));
}

struct Subimage {
    VkImage image;
    uvec2 size;  ///< of the level
    uint32_t level;
    uint32_t layer;
};

void stretch(Device& device, VkCommandBuffer commands, const Subimage& from, const Subimage& to) {
    const auto corner = [](uvec2 size) {
        return VkOffset3D{static_cast<int32_t>(size.x), static_cast<int32_t>(size.y), 1};
    };
    VkImageBlit blit{};
    blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, from.level, from.layer, 1};
    blit.srcOffsets[1] = corner(from.size);
    blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, to.level, to.layer, 1};
    blit.dstOffsets[1] = corner(to.size);
    device.vk.vkCmdBlitImage(commands, from.image, VK_IMAGE_LAYOUT_GENERAL, to.image, VK_IMAGE_LAYOUT_GENERAL, 1, &blit,
                             VK_FILTER_LINEAR);
}

// The smallest mip of the image that is at least as large as the target: a copy from there minifies by less than 2.
uint32_t shrinkSourceLevel(uvec2 size, uvec2 target) {
    uint32_t level = 0;
    while (all(greaterThanEqual(levelExtent(size, level + 1), target)) && levelExtent(size, level) != uvec2(1)) {
        ++level;
    }
    return level;
}

}  // namespace

uint32_t layerLevel(uvec2 layerSize, uvec2 imageSize) {
    uint32_t level = 0;
    while (levelExtent(layerSize, level) != uvec2(1) &&
           all(greaterThanEqual(levelExtent(layerSize, level + 1), imageSize))) {
        ++level;
    }
    return level;
}

Texture uploadTextureArray(Device& device, uvec2 size, std::span<const LayerImage> images, bool srgb,
                           const std::string& name) {
    const auto levels = static_cast<uint32_t>(std::bit_width(std::max(size.x, size.y)));
    const auto layers = static_cast<uint32_t>(images.size());
    Texture array(device,
                  {srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM, size, levels, layers,
                   VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                   ViewKind::array},
                  name);
    const VkImage target = array.image().state->image;
    constexpr VkImageLayout general = VK_IMAGE_LAYOUT_GENERAL;
    device.runNow([&](VkCommandBuffer commands) {
        layoutBarrier(device.vk, commands, target, {}, VK_IMAGE_LAYOUT_UNDEFINED, general);
    });
    for (uint32_t layer = 0; layer < layers; ++layer) {
        const LayerImage& image = images[layer];
        const uint32_t first = layerLevel(size, image.size);
        const uint32_t shrunk = shrinkSourceLevel(image.size, levelExtent(size, first));
        const Texture whole = uploadTexture(device, image.size, image.rgba, srgb, shrunk > 0, image.name);
        const VkImage source = whole.image().state->image;
        device.runNow([&](VkCommandBuffer commands) {
            layoutBarrier(device.vk, commands, source, {}, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, general);
            stretch(device, commands, {source, levelExtent(image.size, shrunk), shrunk, 0},
                    {target, levelExtent(size, first), first, layer});
            for (uint32_t level = first + 1; level < levels; ++level) {
                layoutBarrier(device.vk, commands, target, {}, general, general);
                stretch(device, commands, {target, levelExtent(size, level - 1), level - 1, layer},
                        {target, levelExtent(size, level), level, layer});
            }
        });
    }
    device.runNow([&](VkCommandBuffer commands) {
        layoutBarrier(device.vk, commands, target, {}, general, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
    array.image().state->layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    return array;
}

}  // namespace reflet::gpu
