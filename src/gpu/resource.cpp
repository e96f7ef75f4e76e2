// Images and buffers on the device.
#include "gpu/resource.h"

#include "base/error.h"
#include "gpu/barrier.h"
#include "gpu/device.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace reflet::gpu {

VkImageAspectFlags aspectOf(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

uint32_t bytesPerTexel(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8_UNORM:
            return 1;
        case VK_FORMAT_R8G8B8A8_UNORM:
        case VK_FORMAT_R8G8B8A8_SRGB:
        case VK_FORMAT_A2B10G10R10_UNORM_PACK32:
        case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
        case VK_FORMAT_R16G16_SFLOAT:
        case VK_FORMAT_R32_UINT:
        case VK_FORMAT_R32_SFLOAT:
        case VK_FORMAT_D32_SFLOAT:
            return 4;
        case VK_FORMAT_R16G16B16A16_SFLOAT:
        case VK_FORMAT_R32G32_UINT:
        case VK_FORMAT_R32G32_SFLOAT:
            return 8;
        case VK_FORMAT_R32G32B32A32_UINT:
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return 16;
        default:
            break;
    }
    REFLET_CHECK(false, "no size is known for VkFormat {}", static_cast<int>(format));
    return 0;
}

uint64_t bytesOf(const Image& image) {
    uint64_t texels = 0;
    for (uint32_t level = 0; level < image.mips; ++level) {
        const uvec2 size = max(image.size >> level, uvec2(1));
        texels += uint64_t(size.x) * size.y;
    }
    return texels * image.layers * bytesPerTexel(image.format);
}

namespace {

VkImageViewType viewType(const ImageInfo& info) {
    switch (info.view) {
        case ViewKind::cube:
            return VK_IMAGE_VIEW_TYPE_CUBE;
        case ViewKind::cubeArray:
            return VK_IMAGE_VIEW_TYPE_CUBE_ARRAY;
        case ViewKind::array:
            return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
        default:
            return info.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    }
}

bool isCube(const ImageInfo& info) {
    return info.view == ViewKind::cube || info.view == ViewKind::cubeArray;
}

VkImageView makeView(Device& device, VkImage image, VkImageViewType type, const ImageInfo& info,
                     const VkImageSubresourceRange& range) {
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = image;
    view.viewType = type;
    view.format = info.format;
    view.subresourceRange = range;
    VkImageView made = VK_NULL_HANDLE;
    vkCheck(device.vk.vkCreateImageView(device.handle(), &view, nullptr, &made), "creating an image view");
    return made;
}

}  // namespace

Texture::Texture(Device& device, const ImageInfo& info, const std::string& name)
    : device_(&device), info_(info), state_(std::make_unique<ImageState>()) {
    const uint32_t limit = device.limits().maxImageDimension2D;
    if (info.size.x == 0 || info.size.y == 0 || info.size.x > limit || info.size.y > limit) {
        fail("the image '{}' cannot be {}x{}: this device has images from 1x1 to {}x{}", name, info.size.x, info.size.y,
             limit, limit);
    }
    VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.flags = isCube(info) ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = info.format;
    create.extent = {info.size.x, info.size.y, 1};
    create.mipLevels = info.mips;
    create.arrayLayers = info.layers;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage = info.usage;
    vkCheck(device.vk.vkCreateImage(device.handle(), &create, nullptr, &state_->image), "creating an image");
    VkMemoryRequirements needs{};
    device.vk.vkGetImageMemoryRequirements(device.handle(), state_->image, &needs);
    allocation_ = device.memory().allocate(needs, MemoryUse::device, false);
    vkCheck(device.vk.vkBindImageMemory(device.handle(), state_->image, allocation_.memory, allocation_.offset),
            "binding image memory");
    const VkImageAspectFlags aspect = aspectOf(info.format);
    view_ = makeView(device, state_->image, viewType(info), info, {aspect, 0, info.mips, 0, info.layers});
    const bool written = (info.usage & VK_IMAGE_USAGE_STORAGE_BIT) != 0;
    for (uint32_t level = 0; written && (info.mips > 1 || isCube(info)) && level < info.mips; ++level) {
        mips_.push_back(
            makeView(device, state_->image, VK_IMAGE_VIEW_TYPE_2D_ARRAY, info, {aspect, level, 1, 0, info.layers}));
    }
}

Image Texture::mip(uint32_t level) const {
    REFLET_CHECK(level < mips_.size(), "level {} of {}", level, mips_.size());
    return {state_.get(), mips_[level], info_.format, max(info_.size >> level, uvec2(1)), info_.layers};
}

void Texture::retire() {
    if (device_ == nullptr || !state_) {
        return;
    }
    device_->retire([device = device_, image = state_->image, view = view_, mips = mips_, allocation = allocation_] {
        for (VkImageView mip : mips) {
            device->vk.vkDestroyImageView(device->handle(), mip, nullptr);
        }
        device->vk.vkDestroyImageView(device->handle(), view, nullptr);
        device->vk.vkDestroyImage(device->handle(), image, nullptr);
        device->memory().release(allocation);
    });
    state_.reset();
}

Texture::~Texture() {
    retire();
}

Texture::Texture(Texture&& other) noexcept {
    *this = std::move(other);
}

Texture& Texture::operator=(Texture&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(info_, other.info_);
    std::swap(state_, other.state_);
    std::swap(view_, other.view_);
    std::swap(mips_, other.mips_);
    std::swap(allocation_, other.allocation_);
    return *this;
}

Buffer::Buffer(Device& device, VkDeviceSize size, VkBufferUsageFlags usage, MemoryUse use, const std::string& name)
    : device_(&device), size_(size), state_(std::make_unique<BufferState>()) {
    REFLET_CHECK(size > 0, "buffer '{}'", name);
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = size;
    create.usage = usage;
    vkCheck(device.vk.vkCreateBuffer(device.handle(), &create, nullptr, &state_->buffer), "creating a buffer");
    VkMemoryRequirements needs{};
    device.vk.vkGetBufferMemoryRequirements(device.handle(), state_->buffer, &needs);
    allocation_ = device.memory().allocate(needs, use, true);
    vkCheck(device.vk.vkBindBufferMemory(device.handle(), state_->buffer, allocation_.memory, allocation_.offset),
            "binding buffer memory");
}

void Buffer::retire() {
    if (device_ == nullptr || !state_) {
        return;
    }
    device_->retire([device = device_, buffer = state_->buffer, allocation = allocation_] {
        device->vk.vkDestroyBuffer(device->handle(), buffer, nullptr);
        device->memory().release(allocation);
    });
    state_.reset();
}

Buffer::~Buffer() {
    retire();
}

Buffer::Buffer(Buffer&& other) noexcept {
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(size_, other.size_);
    std::swap(state_, other.state_);
    std::swap(allocation_, other.allocation_);
    return *this;
}

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
